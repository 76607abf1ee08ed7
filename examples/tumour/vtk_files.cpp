// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtk_files.hpp"

#include <string>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include "vtk_library.hpp"

namespace tumour {
namespace {

void add_data(vtkDataSet& set, const std::vector<Named>& data) {
  for (const Named& item : data) {
    const vtkNew<vtkDoubleArray> values;
    values->SetName(item.name.c_str());
    values->SetNumberOfTuples(static_cast<vtkIdType>(item.values.size()));
    for (std::size_t i = 0; i < item.values.size(); ++i) values->SetValue(static_cast<vtkIdType>(i), item.values[i]);
    set.GetPointData()->AddArray(values);
  }
}

}  // namespace

void write_surface(const std::filesystem::path& path, const cambium::Surface<3>& surface,
                   const std::vector<Named>& data) {
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(surface.vertices.size()));
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    points->SetPoint(static_cast<vtkIdType>(i), surface.vertices[i].component);
  }
  const vtkNew<vtkCellArray> triangles;
  for (const auto& element : surface.elements) {
    triangles->InsertNextCell({vtkIdType{element[0]}, vtkIdType{element[1]}, vtkIdType{element[2]}});
  }
  const vtkNew<vtkPolyData> set;
  set->SetPoints(points);
  set->SetPolys(triangles);
  add_data(*set, data);
  write_vtk<vtkXMLPolyDataWriter>(path, *set);
}

template <int D>
void write_fields(const std::filesystem::path& path, const cambium::Lattice<D>& lattice,
                  const std::vector<Named>& data) {
  std::array<int, 3> nodes{1, 1, 1};
  std::array<double, 3> origin{}, spacing;
  spacing.fill(lattice.spacing());
  for (int d = 0; d < D; ++d) {
    nodes[static_cast<std::size_t>(d)] = static_cast<int>(lattice.nodes()[d]);
    origin[static_cast<std::size_t>(d)] = lattice.box().lo[d];
  }
  const vtkNew<vtkImageData> set;
  set->SetDimensions(nodes.data());
  set->SetOrigin(origin.data());
  set->SetSpacing(spacing.data());
  add_data(*set, data);
  write_vtk<vtkXMLImageDataWriter>(path, *set);
}
template void write_fields<2>(const std::filesystem::path&, const cambium::Lattice<2>&, const std::vector<Named>&);
template void write_fields<3>(const std::filesystem::path&, const cambium::Lattice<3>&, const std::vector<Named>&);

}  // namespace tumour
