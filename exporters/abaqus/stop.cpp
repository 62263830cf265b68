// Fills templates/abaqus/frictab_quit.f.
#include "stop.h"

#include <fmt/format.h>

#include "codegen/fortran_build.h"
#include "codegen/fortran_parts.h"

namespace frictab::abaqus {

using namespace codegen;

namespace {

struct Names {
  const char *include, *message, *directory, *combining;
};
const Names& names(Solver solver) {
  static const Names standard = {"aba_param.inc", "stdb_abqerr", "getoutdir",
                                 "abaqus_fric and abaqus_fric_coef"};
  static const Names explicit_ = {"vaba_param.inc", "xplb_abqerr", "vgetoutdir",
                                  "abaqus_vfric, abaqus_vfriction and abaqus_vfric_coef"};
  return solver == Solver::standard ? standard : explicit_;
}

} // namespace

std::string quit(Solver solver) {
  return render_part("abaqus/frictab_quit.f", {.text = {{"include", names(solver).include},
                                                        {"routine", names(solver).message}}});
}

LawSelector interaction(Solver solver, const std::string& argument, const std::string& letters) {
  LawSelector by;
  by.argument = argument;
  by.meaning = "name of the *SURFACE INTERACTION";
  by.alone = "FRICTAB";
  by.deck = {{"FRICTAB", "@"}};
  by.letters = letters;
  by.user_file = fmt::format("the combined sources of {} may stand in one user file, one after "
                             "the other",
                             names(solver).combining);
  return by;
}

LawSelector of_general_contact(LawSelector by) {
  // An assignment without names holds for all surfaces, so only the last law would remain.
  by.deck.insert(by.deck.begin(), {" , , FRICTAB", " <surface>, <surface>, @"});
  return by;
}

std::string directory_routine(Solver solver) {
  return names(solver).directory;
}

void add_stand_ins(BuildVariant& variant, Solver solver) {
  const auto& [include, message, directory, combining] = names(solver);
  fortran::add_source(variant, "solver.f",
                      fmt::format("C     Stand-ins for the solver's routines: the first comes "
                                  "back, where the solver ends the\n"
                                  "C     analysis; the second knows no directory.\n"
                                  "      subroutine {}(lop, text, intv, realv, charv)\n"
                                  "      include '{}'\n"
                                  "      character*(*) text, charv(*)\n"
                                  "      dimension intv(*), realv(*)\n"
                                  "      end\n"
                                  "      subroutine {}(dir, length)\n"
                                  "      character*(*) dir\n"
                                  "      length = 0\n"
                                  "      end\n",
                                  message, include, directory));
}

} // namespace frictab::abaqus
