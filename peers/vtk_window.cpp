#include "peers/vtk_window.h"

#include <vtkGenericOpenGLRenderWindow.h>

namespace nacre {
namespace {

/// A window whose context somebody else opened, by EGL and not by X.
class ContextWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static ContextWindow* New() {
    auto* window = new ContextWindow;
    window->InitializeObjectBase();
    return window;
  }

  /// Loads OpenGL's functions. GLEW, which does it for VTK, looks for an X display after that, and
  /// VTK gives up where there is none; the functions are there all the same.
  void OpenGLInitContext() override {
    if (Initialized) return;
    const int warnings = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();
    vtkGenericOpenGLRenderWindow::OpenGLInitContext();
    vtkObject::SetGlobalWarningDisplay(warnings);
    GlewInitValid = true;
    Initialized = true;
    MaximumHardwareLineWidth = 1.0F;
  }
};

}  // namespace

vtkRenderWindow* new_vtk_window(int width, int height) {
  ContextWindow* window = ContextWindow::New();
  window->SetOwnContext(0);
  window->SetIsCurrent(true);
  window->SetSupportsOpenGL(1);
  window->SetMapped(1);
  window->SetReadyForRendering(true);
  window->SetScreenSize(width, height);
  window->SetSize(width, height);
  window->SetMultiSamples(0);
  window->SwapBuffersOff();
  window->SetFrameBlitModeToNoBlit();  // there is no surface to show pictures on
  return window;
}

}  // namespace nacre
