// The registry of targets.
#include "codegen/exporter.h"

namespace frictab {

const std::vector<Exporter>& all_exporters() {
  return Registry<Exporter>::instance().all();
}

const Exporter* find_exporter(std::string_view name) {
  return Registry<Exporter>::instance().find(name);
}

} // namespace frictab
