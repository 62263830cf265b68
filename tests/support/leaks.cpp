// libhdf5 does not free everything after it has refused a damaged file; what we allocate is
// checked.

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
