// Fills templates/abaqus/frictab_quit.f.
#include "stop.h"

#include "codegen/fortran_parts.h"

namespace frictab::abaqus {

namespace {

bool is_standard(Solver solver) {
  return solver == Solver::standard;
}

} // namespace

std::string quit(Solver solver) {
  TemplateValues values;
  values.text["include"] = is_standard(solver) ? "aba_param.inc" : "vaba_param.inc";
  values.text["routine"] = is_standard(solver) ? "stdb_abqerr" : "xplb_abqerr";
  return fortran::without_last_break(render_template("abaqus/frictab_quit.f", values));
}

std::string directory_routine(Solver solver) {
  return is_standard(solver) ? "getoutdir" : "vgetoutdir";
}

void add_stand_ins(BuildVariant& variant, Solver solver) {
  const std::string include = is_standard(solver) ? "aba_param.inc" : "vaba_param.inc";
  const std::string message = is_standard(solver) ? "stdb_abqerr" : "xplb_abqerr";
  variant.command.push_back("@{dir}/solver.f");
  variant.extra["solver.f"] =
      "C     Stand-ins for the solver's routines: the first comes back, where the solver ends the\n"
      "C     analysis; the second knows no directory.\n"
      "      subroutine " +
      message +
      "(lop, text, intv, realv, charv)\n"
      "      include '" +
      include +
      "'\n"
      "      character*(*) text, charv(*)\n"
      "      dimension intv(*), realv(*)\n"
      "      end\n"
      "      subroutine " +
      directory_routine(solver) +
      "(dir, length)\n"
      "      character*(*) dir\n"
      "      length = 0\n"
      "      end\n";
}

} // namespace frictab::abaqus
