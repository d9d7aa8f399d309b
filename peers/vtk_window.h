#pragma once

class vtkRenderWindow;

namespace nacre {

/// A render window without a window system, in the OpenGL context that is current, which must stay
/// current as long as the window lives.
///
/// VTK's own windows without X are a matter of how VTK was built; this one works with any build.
///
/// @return  owned by the caller (for `vtkSmartPointer::Take`)
vtkRenderWindow* new_vtk_window(int width, int height);

}  // namespace nacre
