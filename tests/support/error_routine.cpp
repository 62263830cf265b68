// XPLB_ABQERR and STDB_ABQERR that come back.
#include "support/error_routine.h"

#include <fmt/format.h>

namespace frictab::test {

void keep_what_is_told(codegen::BuildVariant& variant) {
  const bool standard = variant.extra.count("aba_param.inc") > 0;
  variant.extra["solver.f"] = fmt::format("      subroutine {}(lop, text, intv, realv, charv)\n"
                                          "      include '{}'\n"
                                          "      character*(*) text, charv(*)\n"
                                          "      dimension intv(*), realv(*)\n"
                                          "      character*500 said\n"
                                          "      integer calls, kind\n"
                                          "      common /told/ calls, kind, said\n"
                                          "      calls = calls + 1\n"
                                          "      kind = lop\n"
                                          "      said = text\n"
                                          "      end\n",
                                          standard ? "stdb_abqerr" : "xplb_abqerr",
                                          standard ? "aba_param.inc" : "vaba_param.inc");
}

Told& told(const codegen::Library& library) {
  return *library.find<Told>("told_");
}

} // namespace frictab::test
