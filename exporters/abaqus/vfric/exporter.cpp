// Target `abaqus_vfric`: Abaqus/Explicit, contact pairs. States in VFRIC's arguments, and the input
// deck; the statements are those of every force routine (exporters/abaqus).
#include "codegen/exporter.h"

#include "abaqus/explicit.h"
#include "abaqus/stop.h"

namespace frictab::abaqus::vfric {

using namespace codegen;

namespace {

const char* const source_of_signature =
    "verified: full text of the argument list in a public copy of the manual page, names as in "
    "the v2024 reference; order and count the same in older releases. Recalled, check against "
    "your release: nTemp = 1 where temperatures exist, numDefTfv = 1 for an analytical rigid "
    "surface, negative fStickForce, area 1 of node-based surfaces, STATEV = 0 at the start. "
    "XPLB_ABQERR (only where outside = error, and of several laws) is called as public routines do";

std::string notes() {
  return "For contact PAIRS with *FRICTION, USER; general contact needs abaqus_vfriction or "
         "abaqus_vfric_coef. Pressure is fNormal/areaSec of the surface node, speed "
         "|dSlipFric|/dTimCur (0 where dTimCur = 0). A node without area or normal force gets no "
         "friction; the area of a node-based surface is 1, so that its pressure is a force. " +
         abaqus::force_notes("STATEV", "surface node");
}

abaqus::ForceRoutine routine() {
  abaqus::ForceRoutine r;
  r.about = {.name = "abaqus_vfric",
             .order = 20,
             .title = "Abaqus/Explicit VFRIC, contact pairs",
             .signature_source = source_of_signature,
             .notes = notes()};
  r.entry = "vfric";
  r.gives = abaqus::force_gives({.pressure = "fNormal/areaSec of the surface node",
                                 .speed = "|dSlipFric|/dTimCur (0 where dTimCur = 0)",
                                 .area = "areaSec of the surface node",
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
  r.nodes = "1";
  r.node = "jSecUid(jConSecid(k))";
  r.step = "kStep";
  r.increment = "kInc";
  r.states = "nStateVar";
  r.columns = "1";
  r.state = "statev";
  r.of_point = "jConSecid(k)";
  r.state_name = "STATEV";
  r.state_by = "surface node";
  r.arguments_note = "VFRIC's own 42 arguments; listed is where each state comes from";
  r.user = "user";
  r.selector = abaqus::interaction(abaqus::Solver::explicit_, "surfInt", "fgh");
  r.deck_tail = "*Contact Pair, interaction=FRICTAB, cpset=<name>\n <secondary>, <main>\n";
  return r;
}

class Vfric final : public abaqus::ForceTarget {
public:
  Vfric() : ForceTarget(routine()) {}
};

const Registered<ExporterPointer> registered{make_exporter<Vfric>};

} // namespace

} // namespace frictab::abaqus::vfric
