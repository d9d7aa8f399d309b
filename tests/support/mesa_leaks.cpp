// Read by the leak checker of sanitizer builds, which looks for it under this name.
//
// OSMesaDestroyContext (Mesa 22.3) never frees the context's last window buffer, some hundred bytes
// a context; libOSMesa calls nothing of ours, so what is allocated below it is not ours.
extern "C" const char* __lsan_default_suppressions();  // NOLINT

extern "C" const char* __lsan_default_suppressions() {  // NOLINT
  return "leak:libOSMesa.so\n";
}
