// libhdf5 does not free everything after it has refused a damaged file, nor libudunits2 the words
// of a unit that it does not know; what we allocate is checked.

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5\nleak:libudunits2\n";
}
