// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include <cambium/io/npy.hpp>

#include "child_process.hpp"
#include "label_image.hpp"
#include "vtk_library.hpp"

namespace tumour {
namespace {

using cambium::FileError;
using cambium::Vec;

constexpr int most_voxels_along = 4096;
constexpr double most_packed = 1032.0;  ///< times shorter than its content no stream of zlib is

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw FileError(path.string() + ": " + why);
}

/// Before memory is taken for them: whether the file can hold so many voxels. \return their number
double check_size(vtkXMLImageDataReader& reader, const std::filesystem::path& path) {
  std::array<int, 6> extent{0, -1, 0, -1, 0, -1};
  reader.GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data());
  double voxels = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double along = static_cast<double>(extent[2 * a + 1]) - extent[2 * a] + 1.0;
    if (!(along >= 2.0 && along <= most_voxels_along)) {
      refuse(path, "has " + std::to_string(static_cast<long long>(along)) + " points along axis " + std::to_string(a) +
                       ": 2 to 4096 are needed");
    }
    voxels *= along;
  }
  if (voxels > most_packed * static_cast<double>(std::filesystem::file_size(path))) {
    refuse(path, "is too short for the " + std::to_string(static_cast<long long>(voxels)) +
                     " voxels that its header names (if it is packed by lzma, save it with zlib)");
  }
  return voxels;
}

/// The active scalars, or the only array there is.
vtkDataArray* labels_of(vtkDataSetAttributes& data) {
  if (data.GetScalars()) return data.GetScalars();
  return data.GetNumberOfArrays() == 1 ? data.GetArray(0) : nullptr;
}
bool is_integer(const vtkDataArray& values) {
  const int type = const_cast<vtkDataArray&>(values).GetDataType();
  return type != VTK_FLOAT && type != VTK_DOUBLE && type != VTK_BIT && type != VTK_STRING;
}

void take_labels(vtkDataArray& values, LabelImage& image, const std::filesystem::path& path) {
  if (values.GetNumberOfComponents() != 1 || !is_integer(values)) {
    refuse(path, std::string("its array '") + (values.GetName() ? values.GetName() : "") + "' has values of type " +
                     values.GetDataTypeAsString() + ", " + std::to_string(values.GetNumberOfComponents()) +
                     " a voxel; labels are single integers");
  }
  const auto count = static_cast<std::size_t>(product(image.size));
  if (values.GetNumberOfTuples() != static_cast<vtkIdType>(count)) {
    refuse(path, "has " + std::to_string(values.GetNumberOfTuples()) + " values for " + std::to_string(count) +
                     " voxels: is it cut off?");
  }
  image.labels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double value = values.GetComponent(static_cast<vtkIdType>(i), 0);
    if (std::abs(value) > std::numeric_limits<int>::max()) refuse(path, "has labels beyond 32 bits");
    image.labels[i] = static_cast<int>(value);
  }
}

/// Voxels are the points of an image, or its cells, whose middles lie between the points.
void find_place(vtkImageData& data, bool cells, LabelImage& image, const std::filesystem::path& path) {
  std::array<int, 6> extent;
  data.GetExtent(extent.data());
  const double* const direction = data.GetDirectionMatrix()->GetData();
  data.TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], image.origin.component);
  for (std::size_t a = 0; a < 3; ++a) {
    const double spacing = data.GetSpacing()[a];
    for (std::size_t d = 0; d < 3; ++d) image.axis[a][static_cast<int>(d)] = spacing * direction[3 * d + a];
    image.size[static_cast<int>(a)] = extent[2 * a + 1] - extent[2 * a] + (cells ? 0 : 1);
    if (cells) image.origin = image.origin + 0.5 * image.axis[a];
  }
  require_place(image, path);
}

/// In this process. \throws cambium::FileError, or crashes: the library believes what files say of themselves
LabelImage read_here(const std::filesystem::path& path) {
  const double own = 1e8 + 20.0 * static_cast<double>(std::filesystem::file_size(path));
  allow_memory(own);
  VtkComplaints complaints;
  const vtkNew<vtkXMLImageDataReader> reader;
  complaints.hear(*reader);
  complaints.hear(*reader->GetExecutive());
  reader->SetReaderErrorObserver(complaints.command());
  reader->SetParserErrorObserver(complaints.command());
  reader->SetFileName(path.c_str());
  const auto check = [&] {
    if (reader->GetErrorCode() == 0 && complaints.text().empty()) return;
    refuse(path, "the VTK library cannot read it as an image: " + complaints.text());
  };
  reader->UpdateInformation();
  check();
  allow_memory(own + 40.0 * check_size(*reader, path));  // of any type, in pieces, and labels
  reader->Update();
  check();
  vtkImageData& data = *reader->GetOutput();
  vtkDataArray* const points = labels_of(*data.GetPointData());
  vtkDataArray* const cells = points ? nullptr : labels_of(*data.GetCellData());
  if (!points && !cells) refuse(path, "has no array of labels, or several of which none is the active scalars");
  LabelImage image;
  find_place(data, cells != nullptr, image, path);
  take_labels(points ? *points : *cells, image, path);
  return image;
}

/// Size, axes, origin and labels, as bytes.
struct Head {
  cambium::Index<3> size;
  std::array<Vec<3>, 3> axis;
  Vec<3> origin;
};
std::string bytes_of(const LabelImage& image) {
  const Head head{image.size, image.axis, image.origin};
  std::string bytes(sizeof head + image.labels.size() * sizeof(int), '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  std::memcpy(bytes.data() + sizeof head, image.labels.data(), image.labels.size() * sizeof(int));
  return bytes;
}
LabelImage image_from(const std::string& bytes) {
  Head head;
  std::memcpy(&head, bytes.data(), sizeof head);
  LabelImage image{head.size, head.axis, head.origin, std::vector<int>((bytes.size() - sizeof head) / sizeof(int))};
  std::memcpy(image.labels.data(), bytes.data() + sizeof head, image.labels.size() * sizeof(int));
  return image;
}

}  // namespace

// The library crashes on some damaged files.
LabelImage read_vti(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) refuse(path, "cannot be read: check that it is there");
  const auto seconds = static_cast<unsigned>(5 + std::filesystem::file_size(path) / 1000000);
  return image_from(in_child_process(path.string(), seconds, [&] { return bytes_of(read_here(path)); }));
}

void write_vti(const std::filesystem::path& path, const LabelImage& image) {
  const vtkNew<vtkImageData> data;
  const vtkNew<vtkMatrix3x3> direction;
  std::array<int, 3> size;
  std::array<double, 3> spacing;
  for (std::size_t a = 0; a < 3; ++a) {
    size[a] = static_cast<int>(image.size[static_cast<int>(a)]);
    spacing[a] = norm(image.axis[a]);
    for (int d = 0; d < 3; ++d) direction->SetElement(d, static_cast<int>(a), image.axis[a][d] / spacing[a]);
  }
  data->SetDimensions(size.data());
  data->SetSpacing(spacing.data());
  data->SetOrigin(image.origin.component);
  data->SetDirectionMatrix(direction);
  const vtkNew<vtkUnsignedCharArray> labels;
  labels->SetName("labels");
  labels->SetNumberOfTuples(static_cast<vtkIdType>(image.labels.size()));
  for (std::size_t i = 0; i < image.labels.size(); ++i) {
    labels->SetValue(static_cast<vtkIdType>(i), static_cast<unsigned char>(image.labels[i]));
  }
  data->GetPointData()->SetScalars(labels);
  write_vtk<vtkXMLImageDataWriter>(path, *data);
}

}  // namespace tumour
