// A table's description of itself besides its values: its origin, the states it covers, its drift
// from the law.
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

// The record of one input, an axis or a state of the combination; numbers in its canonical unit. In
// a file the input's name follows the attribute's.
struct InputRecord {
  std::optional<double> low = {}; // range for which the table was made and verified
  std::optional<double> high = {};
  std::optional<double> worst_case_at = {}; // the state where worst_case_MPa was found
  // reason for the range: "job file", "training data", ...
  std::optional<std::string> range_from = {};
  // reason to clamp below the low end, where the law usually continues
  std::optional<std::string> held_why = {};
  // For inputs that are not canonical states (recorded columns, histories):
  std::optional<std::string> unit = {};
  std::optional<std::string> long_name = {}; // meaning
  std::optional<std::string> levels = {};    // names of a text column's numbers: "0 = A, 1 = B"
  bool operator==(const InputRecord&) const = default;
};

// Each member is absent where the table does not state it, as in one made elsewhere.
struct TableRecord {
  std::optional<std::string> tool_version;   // of the frictab that made the table
  std::optional<std::string> data_hash;      // hash of the data on which the law was calibrated
  std::optional<std::string> data_origin;    // "measured", "synthetic", or any text
  std::optional<std::string> formula;        // the law's, for people
  std::optional<std::string> shear_yield;    // "mises", "tresca", "flow_stress": k from sigma_f
  std::optional<std::string> refinement;     // course of the choice of nodes
  std::optional<std::string> tolerance_from; // in words, if frictab chose it
  std::optional<double> quantile;            // of the experiments, 0 .. 1
  std::optional<double> gain;           // factor of that quantile on the law; 1 for the law itself
  std::optional<double> tolerance_MPa;  // drift to which the nodes were made
  std::optional<double> worst_case_MPa; // largest drift found over the whole range
  std::optional<double> proven_drift_MPa; // no state in the range drifts further
  std::optional<double> asked_nodes;      // table.nodes of the job
  std::optional<double> asked_bytes;      // table.max_bytes of the job
  // share of the range that is far from the tests (table/distance.h)
  std::optional<double> share_far;
  std::map<std::string, InputRecord> inputs; // by name
  TableAttributes others; // attributes of a file that are not members, kept as they are

  // Returns the record of one input, an empty one if nothing is known.
  const InputRecord& input(const std::string& name) const;
  bool operator==(const TableRecord&) const = default;
};

// Converts the record to the attributes of a file and of `table info`.
TableAttributes attributes_of(const TableRecord& record);

// Stores one attribute in its member; in `others` if the record has no member of that name and
// kind.
void take_attribute(TableRecord& record, const std::string& name, const std::string& text);
void take_attribute(TableRecord& record, const std::string& name, double number);

} // namespace frictab::table
