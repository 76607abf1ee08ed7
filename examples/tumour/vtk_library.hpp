// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vtkCallbackCommand.h>
#include <vtkDataSet.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

#include <cambium/io/npy.hpp>

#include "files.hpp"

namespace tumour {

/// What objects of the VTK library complain of first; they then print nothing.
class VtkComplaints {
 public:
  VtkComplaints() {
    command_->SetClientData(&text_);
    command_->SetCallback([](vtkObject*, unsigned long, void* text, void* said) {
      if (said) keep(*static_cast<std::string*>(text), static_cast<const char*>(said));
    });
  }
  ~VtkComplaints() { command_->SetCallback(nullptr); }  // objects may live longer
  VtkComplaints(const VtkComplaints&) = delete;
  VtkComplaints& operator=(const VtkComplaints&) = delete;
  void hear(vtkObject& object) {
    object.AddObserver(vtkCommand::ErrorEvent, command_);
    object.AddObserver(vtkCommand::WarningEvent, command_);
  }
  vtkCommand* command() { return command_; }
  const std::string& text() const { return text_; }

 private:
  /// The first one alone, without the line of the library's source and the object's address, which come before.
  static void keep(std::string& text, std::string said) {
    if (!text.empty()) return;
    const std::size_t address = said.find("): ");
    if (address != std::string::npos) said.erase(0, address + 3);
    while (!said.empty() && said.back() == '\n') said.pop_back();
    text = said.empty() ? "it does not say why" : said;
  }

  std::string text_;
  vtkNew<vtkCallbackCommand> command_;
};

/// Writes a data set with a writer of the library, binary, compressed. To a string first: files appear whole or not at
/// all. \throws cambium::FileError
template <class Writer>
void write_vtk(const std::filesystem::path& path, vtkDataSet& set) {
  VtkComplaints complaints;
  const vtkNew<Writer> writer;
  complaints.hear(set);
  complaints.hear(*writer);
  complaints.hear(*writer->GetExecutive());
  writer->SetInputData(&set);
  writer->SetCompressorTypeToZLib();
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->WriteToOutputStringOn();
  // Some errors are only told: Write() returns 1 for data that do not fit, too.
  if (writer->Write() != 1 || writer->GetErrorCode() != 0 || !complaints.text().empty()) {
    throw cambium::FileError(cambium::detail::message("the VTK library cannot write ", path.string(),
                                                      ", which is as it was before: ", complaints.text()));
  }
  write_whole(path, writer->GetOutputString());
}

}  // namespace tumour
