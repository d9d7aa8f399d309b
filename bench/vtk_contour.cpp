#include "bench/vtk_contour.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>

#include "bench/vtk_surface.h"
#include "peers/vtk_image.h"

namespace nacre {

struct VtkContour::Image {
  vtkSmartPointer<vtkImageData> samples;
  double slope;
  double intercept;
};

VtkContour::VtkContour(const Volume& volume)
    : image_(
          std::make_unique<Image>(Image{vtkSmartPointer<vtkImageData>::Take(new_vtk_image(volume)),
                                        volume.slope, volume.intercept})) {}

VtkContour::~VtkContour() = default;

TriangleMesh VtkContour::decimated(double value, double part) const {
  vtkNew<vtkImageData> image;  // a pipeline of this thread's, on the same samples
  image->ShallowCopy(image_->samples);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->SetValue(0, (value - image_->intercept) / image_->slope);
  contour->Update();
  if (contour->GetOutput()->GetNumberOfPolys() == 0) return {};
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputConnection(contour->GetOutputPort());
  decimation->SetTargetReduction(1.0 - part);
  decimation->Update();
  return surface_of(*decimation->GetOutput());
}

}  // namespace nacre
