// Target `abaqus_vfriction`: Abaqus/Explicit, general contact. States in VFRICTION's arguments, and
// the input deck; the statements are those of every force routine (exporters/abaqus).
#include "codegen/exporter.h"

#include "abaqus/deck.h"
#include "abaqus/explicit.h"
#include "abaqus/stop.h"

namespace frictab::abaqus::vfriction {

using namespace codegen;

namespace {

const char* const source_of_signature =
    "verified: argument list, dimensions and sizes of the arrays in three public routines that "
    "ran in production (RWTH WZL), names as in the 2017 and v2023 references, keyword lines in "
    "the 6.14 keyword guide. Recalled, check against your release: nTemp = 1 where temperatures "
    "exist, negative fStickForce, STATE = 0 at the start. Not known: what the 4 columns of STATE "
    "mean for edges. XPLB_ABQERR (only where outside = error, and of several laws) is called as "
    "public routines do";

std::string notes() {
  return "For GENERAL contact with *FRICTION, USER=FRICTION; contact pairs need abaqus_vfric. "
         "Pressure is fNormal/areaCont of the contact point, speed |dSlipFric|/rData(3) (0 where "
         "rData(3) = 0). A contact point is one node or edge of the secondary surface next to one "
         "main surface: a node in a corner is two points, each with a history of its own. Points "
         "of edges carry 4 columns of states: each is advanced alike, the law takes their mean. "
         "Surface names are blank in general contact: different laws need different interactions. "
         "Node and edge contact come in blocks of their own. " +
         abaqus::force_notes("STATE", "contact point");
}

abaqus::ForceRoutine routine() {
  abaqus::ForceRoutine r;
  r.about = {.name = "abaqus_vfriction",
             .order = 21,
             .title = "Abaqus/Explicit VFRICTION, general contact",
             .signature_source = source_of_signature,
             .notes = notes()};
  r.entry = "vfriction";
  r.gives = abaqus::force_gives({.pressure = "fNormal/areaCont of the contact point",
                                 .speed = "|dSlipFric|/rData(3) (0 where rData(3) = 0)",
                                 .area = "areaCont of the contact point",
                                 .state_name = "STATE",
                                 .temperature = "tempSlv(k)",
                                 .temperature_main = "tempMst(min(k,nBlockAnal))",
                                 .fields = "nFields",
                                 .field = "fieldSlv(@{field},k)",
                                 .field_main = "fieldMst(@{field},min(k,nBlockAnal))",
                                 .main = "nBlockAnal"});
  r.gives.field.text = "mean of both surfaces' field variable @{field}";
  r.points = "nBlock";
  r.time_increment = "rData(3)";
  r.area = "areaCont(k)";
  r.nodes = "nNodSlv";
  r.node = "jConSlvUid(i,k)";
  r.step = "jFlags(1)";
  r.increment = "jFlags(2)";
  r.states = "nStates";
  r.columns = "nNodState";
  r.state = "state";
  r.of_point = "j,k";
  r.state_name = "STATE";
  r.state_by = "contact point";
  r.arguments_note = "VFRICTION's own 39 arguments; listed is where each state comes from";
  r.user = "user=friction";
  r.selector =
      abaqus::of_general_contact(abaqus::interaction(abaqus::Solver::explicit_, "surfInt", "pqr"));
  r.deck_tail = abaqus::general_contact_lines;
  return r;
}

class Vfriction final : public abaqus::ForceTarget {
public:
  Vfriction() : ForceTarget(routine()) {}
};

const Registered<ExporterPointer> registered{make_exporter<Vfriction>};

} // namespace

} // namespace frictab::abaqus::vfriction
