// Target `abaqus_vfric`: Abaqus/Explicit, contact pairs. What VFRIC's arguments hold and how the
// input deck refers to it; the statements are those of every force routine (exporters/abaqus).
#include "codegen/exporter.h"

#include "abaqus/explicit.h"
#include "codegen/values_file.h"

namespace frictab::abaqus::vfric {

namespace {

const abaqus::ForceRoutine& routine() {
  static const abaqus::ForceRoutine one = [] {
    abaqus::ForceRoutine r;
    r.target = "abaqus_vfric";
    r.entry = "vfric";
    r.gives = abaqus::force_gives({.pressure = "fNormal/areaSec of the surface node",
                                   .speed = "|dSlipFric|/dTimCur (0 where dTimCur = 0)",
                                   .state_name = "STATEV",
                                   .temperature = "tempSec(k)",
                                   .temperature_main = "tempMain(min(k,numDefTfv))",
                                   .fields = "nPred",
                                   .field = "preDefSec(k,@{field})",
                                   .field_main = "preDefMain(min(k,numDefTfv),@{field})",
                                   .main = "numDefTfv"});
    r.points = "nContact";
    r.time_increment = "dTimCur";
    r.area = "areaSec(jConSecid(k))";
    r.states = "nStateVar";
    r.columns = "1";
    r.state = "statev(1,jConSecid(k))";
    r.state_name = "STATEV";
    r.state_by = "surface node";
    r.arguments_note = "VFRIC's own 42 arguments; listed is where each state comes from";
    r.user = "user";
    r.deck_tail = "*Contact Pair, interaction=FRICTAB, cpset=<name>\n <secondary>, <main>\n";
    return r;
  }();
  return one;
}

SourceBundle generate(const ExportRequest& request) {
  return abaqus::force_bundle(routine(), request);
}

std::vector<BuildVariant> variants(const ExportRequest& request) {
  return abaqus::explicit_variants(request, "frictab_vfric.f", "abaqus/vfric/driver.f");
}

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau) {
  abaqus::drive_explicit(routine().gives, fortran::Coefficient::stress, built, request, rows,
                         columns, tau);
}

Exporter exporter() {
  Exporter out;
  out.name = "abaqus_vfric";
  out.order = 20;
  out.title = "Abaqus/Explicit VFRIC, contact pairs";
  out.signature_source =
      "verified: full text of the argument list in a public copy of the manual page, names as in "
      "the v2024 reference; order and count the same in older releases. Recalled, check against "
      "your release: nTemp = 1 where temperatures exist, numDefTfv = 1 for an analytical rigid "
      "surface, negative fStickForce, area 1 of node-based surfaces, STATEV = 0 at the start. "
      "XPLB_ABQERR (only where outside = error) is called as public routines do";
  out.notes =
      "For contact PAIRS with *FRICTION, USER; general contact needs abaqus_vfriction or "
      "abaqus_vfric_coef. Pressure is fNormal/areaSec of the surface node, speed "
      "|dSlipFric|/dTimCur (0 where dTimCur = 0). A node without area or normal force gets no "
      "friction; the area of a node-based surface is 1, so that its pressure is a force. " +
      abaqus::force_notes("STATEV", "surface node");
  out.options = {values_option()};
  out.generate = generate;
  out.variants = variants;
  out.drive = drive;
  return out;
}

const Registered<Exporter> registered{exporter};

} // namespace

} // namespace frictab::abaqus::vfric
