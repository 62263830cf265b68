// Where each state of the law comes from inside VFRIC.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/exporter.h"
#include "codegen/fill.h"

namespace frictab::abaqus_vfric {

enum class Source { pressure, speed, slip, temperature, property, field, constant };

struct VfricInput {
  InputArgument argument;
  Source source = Source::property;
  std::size_t property = 0;       // number in PROPS from 1, where the source is property or
                                  // temperature (the reference where nTemp = 0)
  std::size_t field = 0;          // predefined field variable, from 1
  std::optional<double> fallback; // canonical: the constant, or what stands in for a missing value
};

// The states the table needs, in the order of table.inputs(), by the job's [export.inputs]. Throws
// InputError with every fault of these choices.
std::vector<VfricInput> vfric_inputs(const ExportRequest& request);

std::size_t property_count(const std::vector<VfricInput>& inputs);

// "property 2", "mean of the two surfaces' field variable 1", ... for people.
std::string source_text(const VfricInput& input);

} // namespace frictab::abaqus_vfric
