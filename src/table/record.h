// What a table says about itself beyond its values: where it comes from, over which states it
// holds, how far it is from its law.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace frictab::table {

// Root attributes of a table file by name, each one text or one number.
struct TableAttributes {
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;
  bool operator==(const TableAttributes&) const = default;
};

// Of one input, an axis or a state of the combination; numbers in its canonical unit. In a file
// the input's name follows the attribute's.
struct InputRecord {
  std::optional<double> low = {}; // of the range for which the table was made and verified
  std::optional<double> high = {};
  std::optional<double> worst_case_at = {};   // the state where worst_case_MPa was found
  std::optional<std::string> range_from = {}; // why this range: "job file", "training data", ...
  std::optional<std::string> held_why = {};   // below its low end, where the law usually goes on
  // Of inputs that are no canonical state (recorded columns, histories):
  std::optional<std::string> unit = {};
  std::optional<std::string> long_name = {}; // meaning
  std::optional<std::string> levels = {};    // of a text column: "0 = A, 1 = B"
  bool operator==(const InputRecord&) const = default;
};

// Each is absent where a table does not say it, as one that was made elsewhere.
struct TableRecord {
  std::optional<std::string> tool_version;   // of the frictab that made it
  std::optional<std::string> data_hash;      // of the data the law was calibrated on
  std::optional<std::string> data_origin;    // "measured", "synthetic", or any text
  std::optional<std::string> formula;        // of the law, for people
  std::optional<std::string> shear_yield;    // "mises", "tresca", "flow_stress": k of sigma_f
  std::optional<std::string> refinement;     // how the nodes were chosen
  std::optional<std::string> tolerance_from; // in words, where the job left it to frictab
  std::optional<double> quantile;            // of the experiments, 0 .. 1
  std::optional<double> gain;                // factor of that quantile on the law, 1
  std::optional<double> tolerance_MPa;       // drift that the nodes were made to
  std::optional<double> worst_case_MPa;      // largest drift found over the whole range
  std::optional<double> proven_drift_MPa;    // no state in the range drifts further
  std::optional<double> asked_nodes;         // table.nodes of the job
  std::optional<double> asked_bytes;         // table.max_bytes of the job
  std::optional<double> share_far;           // from every test, of the range (table/distance.h)
  std::map<std::string, InputRecord> inputs; // by name
  TableAttributes others;                    // of a file, kept as they are

  // Of one input; empty where nothing is known.
  const InputRecord& input(const std::string& name) const;
  bool operator==(const TableRecord&) const = default;
};

// The record as a file and `table info` name it.
TableAttributes attributes_of(const TableRecord& record);

// Takes one attribute in. What the record has no member for, or for the other kind, goes to
// `others`.
void take_attribute(TableRecord& record, const std::string& name, const std::string& text);
void take_attribute(TableRecord& record, const std::string& name, double number);

} // namespace frictab::table
