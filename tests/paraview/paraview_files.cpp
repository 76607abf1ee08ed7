// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE paraview_files
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <tuple>
#include <unistd.h>
#include <vector>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <cambium/io/npy.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/ball.hpp>
#include <cambium/levelset/surface.hpp>

#include "child_process.hpp"
#include "label_image.hpp"
#include "vtk_files.hpp"

using namespace cambium;

namespace {

/// A folder that is gone with the test.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("paraview_files_" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path); }
};

template <class Reader>
void read(Reader& reader, const std::filesystem::path& path) {
  reader.SetFileName(path.c_str());
  reader.Update();
  BOOST_REQUIRE(reader.GetErrorCode() == 0);
}
void check_values(vtkDataSet& set, const tumour::Named& item) {
  vtkDataArray* const values = set.GetPointData()->GetArray(item.name.c_str());
  BOOST_REQUIRE(values);
  BOOST_REQUIRE(values->GetNumberOfTuples() == static_cast<vtkIdType>(item.values.size()));
  BOOST_TEST(values->GetNumberOfComponents() == 1);
  for (std::size_t i = 0; i < item.values.size(); ++i) {
    BOOST_REQUIRE(values->GetComponent(static_cast<vtkIdType>(i), 0) == item.values[i]);
  }
}
std::vector<double> numbers(std::size_t count, double scale) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(scale / static_cast<double>(i + 3));
  return values;
}

/// Not a cube, and not at the origin: axes and corners cannot be taken for each other.
template <int D>
Lattice<D> oblong() {
  Box<D> box{Vec<D>::constant(-1.0), Vec<D>::constant(1.0)};
  box.hi[0] = 2.0;
  box.lo[1] = -1.5;
  return Lattice<D>::bounded_box(box, 24);
}

}  // namespace

BOOST_AUTO_TEST_CASE(surfaces_come_back_as_they_are) {
  const LevelSet<ClosestPoint, 3> level_set(oblong<3>(), Ball<3>({0.3, -0.2, 0.0}, 0.6));
  const auto surface = extract_surface(level_set.band());
  const std::vector<tumour::Named> data{{"pressure", numbers(surface.vertices.size(), 2.0)},
                                        {"curvature", surface.curvatures}};
  const Folder folder;
  tumour::write_surface(folder.path / "ball.vtp", surface, data);
  const vtkNew<vtkXMLPolyDataReader> reader;
  read(*reader, folder.path / "ball.vtp");
  vtkPolyData& set = *reader->GetOutput();
  BOOST_REQUIRE(set.GetNumberOfPoints() == static_cast<vtkIdType>(surface.vertices.size()));
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    for (int d = 0; d < 3; ++d) BOOST_REQUIRE(set.GetPoint(static_cast<vtkIdType>(i))[d] == surface.vertices[i][d]);
  }
  BOOST_REQUIRE(set.GetNumberOfPolys() == static_cast<vtkIdType>(surface.elements.size()));
  const vtkNew<vtkIdList> corners;
  for (std::size_t i = 0; i < surface.elements.size(); ++i) {
    set.GetCellPoints(static_cast<vtkIdType>(i), corners);
    BOOST_REQUIRE(corners->GetNumberOfIds() == 3);
    for (int k = 0; k < 3; ++k) {
      BOOST_REQUIRE(corners->GetId(k) == static_cast<vtkIdType>(surface.elements[i][static_cast<std::size_t>(k)]));
    }
  }
  for (const auto& item : data) check_values(set, item);
}

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(fields_come_back_on_their_lattice, N, Dimensions) {
  constexpr int D = N::value;
  const auto lattice = oblong<D>();
  const std::vector<tumour::Named> data{{"phi", numbers(lattice.size(), 1.0)},
                                        {"nutrient", numbers(lattice.size(), 7.0)}};
  const Folder folder;
  tumour::write_fields(folder.path / "fields.vti", lattice, data);
  const vtkNew<vtkXMLImageDataReader> reader;
  read(*reader, folder.path / "fields.vti");
  vtkImageData& set = *reader->GetOutput();
  BOOST_REQUIRE(set.GetNumberOfPoints() == static_cast<vtkIdType>(lattice.size()));
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Vec<D> x = lattice.position(lattice.node(i));
    for (int d = 0; d < D; ++d) BOOST_REQUIRE(std::abs(set.GetPoint(static_cast<vtkIdType>(i))[d] - x[d]) < 1e-14);
  }
  for (const auto& item : data) check_values(set, item);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_written_is_said_and_leaves_the_file_as_it_was) {
  const auto lattice = oblong<2>();
  const std::vector<tumour::Named> data{{"phi", numbers(lattice.size(), 1.0)}};
  const Folder folder;
  BOOST_CHECK_THROW(tumour::write_fields(folder.path / "nowhere" / "fields.vti", lattice, data), FileError);
  BOOST_CHECK_THROW(tumour::write_fields(folder.path / "short.vti", lattice, {{"phi", numbers(3, 1.0)}}), FileError);
  BOOST_TEST(std::filesystem::is_empty(folder.path));
}

namespace {

/// Unequal sizes, spacings and turned axes; a label for every voxel.
tumour::LabelImage turned_image() {
  tumour::LabelImage image;
  image.size = {4, 3, 5};
  image.axis = {Vec<3>{0.3, 0.4, 0.0}, Vec<3>{-0.16, 0.12, 0.0}, Vec<3>{0.0, 0.0, 0.7}};
  image.origin = {1.0, -2.0, 3.0};
  for (int i = 0; i < 60; ++i) image.labels.push_back(i % 7);
  return image;
}
void check_same(const tumour::LabelImage& a, const tumour::LabelImage& b) {
  BOOST_TEST((a.size == b.size));
  BOOST_TEST(a.labels == b.labels, boost::test_tools::per_element());
  BOOST_TEST(norm(a.origin - b.origin) < 1e-14);
  for (std::size_t k = 0; k < 3; ++k) BOOST_TEST(norm(a.axis[k] - b.axis[k]) < 1e-14);
}
/// An image of text, of 3 x 3 x 3 points from (5, 6, 7) on, with the arrays that are given.
std::filesystem::path write_text(const Folder& folder, const std::string& arrays, const std::string& last = "9") {
  const auto path = folder.path / "text.vti";
  const std::string extent = "\"5 7 6 8 7 " + last + "\"";
  std::ofstream(path) << "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData "
                         "WholeExtent="
                      << extent << " Origin=\"1 2 3\" Spacing=\"0.5 1 2\"><Piece Extent=" << extent << ">" << arrays
                      << "</Piece></ImageData></VTKFile>\n";
  return path;
}
std::string array(const char* type, const char* name, int count) {
  std::string text = std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"ascii\">";
  for (int i = 0; i < count; ++i) text += " " + std::to_string(i + 200);
  return text + "</DataArray>";
}

}  // namespace

BOOST_AUTO_TEST_CASE(label_images_come_back_as_they_are) {
  const Folder folder;
  const auto image = turned_image();
  for (const char* name : {"image.vti", "image.nrrd"}) {
    tumour::write_image(folder.path / name, image);
    check_same(tumour::read_image(folder.path / name), image);
  }
}

BOOST_AUTO_TEST_CASE(label_images_have_labels_at_points_or_in_cells) {
  const Folder folder;
  for (const char* type : {"UInt8", "Int16", "UInt16", "Int32", "Int64"}) {
    const auto image = tumour::read_vti(write_text(folder, "<PointData>" + array(type, "a", 27) + "</PointData>"));
    BOOST_TEST((image.size == Index<3>{3, 3, 3}));
    BOOST_TEST(norm(image.origin - Vec<3>{3.5, 8.0, 17.0}) == 0.0);  // origin + the first index times the spacing
    BOOST_TEST(norm(image.axis[2] - Vec<3>{0.0, 0.0, 2.0}) == 0.0);
    BOOST_TEST(image.labels[26] == 226);
  }
  const auto cells = tumour::read_vti(write_text(folder, "<CellData>" + array("Int32", "a", 8) + "</CellData>"));
  BOOST_TEST((cells.size == Index<3>{2, 2, 2}));
  BOOST_TEST(norm(cells.origin - Vec<3>{3.75, 8.5, 18.0}) == 0.0);
  BOOST_TEST(cells.labels[7] == 207);
  const std::string two = array("Int32", "a", 27) + array("UInt8", "b", 27);
  const auto active = tumour::read_vti(write_text(folder, "<PointData Scalars=\"b\">" + two + "</PointData>"));
  BOOST_TEST(active.labels[1] == 201);
  BOOST_CHECK_THROW(tumour::read_vti(write_text(folder, "<PointData>" + two + "</PointData>")), FileError);
}

BOOST_AUTO_TEST_CASE(label_images_that_are_not_as_they_should_be_are_refused) {
  const Folder folder;
  const auto refused = [](const std::filesystem::path& path, const std::string& why) {
    BOOST_CHECK_EXCEPTION(tumour::read_vti(path), FileError, [&](const FileError& error) {
      BOOST_TEST_INFO(error.what());
      return std::string(error.what()).find(why) != std::string::npos;
    });
  };
  refused(folder.path / "none.vti", "check that it is there");
  refused(write_text(folder, ""), "no array");
  refused(write_text(folder, "<PointData>" + array("Float32", "a", 27) + "</PointData>"), "float");
  refused(write_text(folder, "<PointData>" + array("Int32", "a", 27) + "</PointData>", "7"), "axis 2");
  refused(write_text(folder, "<PointData>" + array("Int32", "a", 27) + "</PointData>", "4000000"), "4096");
  refused(write_text(folder, "<PointData>" + array("Int32", "a", 20) + "</PointData>"), "");
  std::ofstream(folder.path / "text.vti") << "<VTKFile type=\"ImageData\" <<";
  refused(folder.path / "text.vti", "VTK library cannot read");
  tumour::write_vti(folder.path / "cut.vti", turned_image());
  std::filesystem::resize_file(folder.path / "cut.vti", std::filesystem::file_size(folder.path / "cut.vti") - 40);
  refused(folder.path / "cut.vti", "");
}

BOOST_AUTO_TEST_CASE(what_reads_a_file_may_crash_or_come_to_no_end) {
  const auto said = [](const std::function<std::string()>& work) {
    try {
      return tumour::in_child_process("file", 1, work);
    } catch (const FileError& error) {
      return "refused: " + std::string(error.what());
    }
  };
  const std::string large(1000000, 'x');  // more than a pipe holds
  BOOST_TEST((said([&] { return large; }) == large));
  BOOST_TEST(said([] { return std::string(); }) == "");
  BOOST_TEST(said([]() -> std::string { throw ValueError("as I said"); }) == "refused: as I said");
  const auto crash = [] {
    std::raise(SIGSEGV);
    return std::string();
  };
  BOOST_TEST(said(crash) == "refused: file: what reads it crashed: it is damaged");
  const auto endless = [] {
    for (volatile bool more = true; more;) {
    }
    return std::string();
  };
  BOOST_TEST(said(endless) == "refused: file: reading it comes to no end: it is damaged");
  const auto greedy = [] {
    tumour::allow_memory(1e7);
    return std::string(100000000, 'x');
  };
  BOOST_TEST(said(greedy).substr(0, 7) == "refused");
}
