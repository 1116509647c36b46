#include "render/scene/vtk_triangles.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace render {

vtkSmartPointer<vtkActor> triangle_actor(const Triangles& triangles, bool translucent) {
  const auto count = static_cast<vtkIdType>(triangles.xyz.size() / 3);
  vtkNew<vtkFloatArray> xyz;
  xyz->SetNumberOfComponents(3);
  xyz->SetNumberOfTuples(count);
  std::copy(triangles.xyz.begin(), triangles.xyz.end(), xyz->GetPointer(0));
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  const int components = translucent ? 4 : 3;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("colour");
  colours->SetNumberOfComponents(components);
  colours->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
    std::copy_n(&triangles.rgba[static_cast<std::size_t>(4 * i)], components, colours->GetPointer(components * i));
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(count / 3, count);
  for (vtkIdType i = 0; i < count; i += 3) {
    const vtkIdType corners[3] = {i, i + 1, i + 2};
    cells->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUsePointData();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  if (translucent)
    actor->ForceTranslucentOn();
  else
    actor->ForceOpaqueOn();
  return actor;
}

}  // namespace render
