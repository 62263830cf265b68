// Members of a table's record and their names in files.
#include "table/record.h"

#include <utility>
#include <vector>

namespace frictab::table {

namespace {

template <class T> struct Names {
  std::vector<std::pair<std::string, std::optional<T> TableRecord::*>> of_table;
  // prefix; the input's name follows
  std::vector<std::pair<std::string, std::optional<T> InputRecord::*>> of_input;
  std::map<std::string, T> TableAttributes::*all;
};

const Names<std::string> text_names = {{{"tool_version", &TableRecord::tool_version},
                                        {"data_hash", &TableRecord::data_hash},
                                        {"data_origin", &TableRecord::data_origin},
                                        {"formula", &TableRecord::formula},
                                        {"shear_yield", &TableRecord::shear_yield},
                                        {"refinement", &TableRecord::refinement},
                                        {"tolerance_from", &TableRecord::tolerance_from}},
                                       {{"range_from_", &InputRecord::range_from},
                                        {"held_why_", &InputRecord::held_why},
                                        {"units_", &InputRecord::unit},
                                        {"long_name_", &InputRecord::long_name},
                                        {"levels_", &InputRecord::levels}},
                                       &TableAttributes::texts};

const Names<double> number_names = {{{"quantile", &TableRecord::quantile},
                                     {"gain", &TableRecord::gain},
                                     {"tolerance_MPa", &TableRecord::tolerance_MPa},
                                     {"worst_case_MPa", &TableRecord::worst_case_MPa},
                                     {"proven_drift_MPa", &TableRecord::proven_drift_MPa},
                                     {"asked_nodes", &TableRecord::asked_nodes},
                                     {"asked_bytes", &TableRecord::asked_bytes},
                                     {"share_far", &TableRecord::share_far}},
                                    {{"range_low_", &InputRecord::low},
                                     {"range_high_", &InputRecord::high},
                                     {"worst_case_at_", &InputRecord::worst_case_at}},
                                    &TableAttributes::numbers};

template <class T>
void add(TableAttributes& attributes, const TableRecord& record, const Names<T>& named) {
  std::map<std::string, T>& all = attributes.*named.all;
  for (const auto& [name, member] : named.of_table)
    if (record.*member) all[name] = *(record.*member);
  for (const auto& [input, known] : record.inputs)
    for (const auto& [name, member] : named.of_input)
      if (known.*member) all[name + input] = *(known.*member);
}

template <class T>
void take(TableRecord& record, const std::string& name, const T& value, const Names<T>& named) {
  for (const auto& [known, member] : named.of_table)
    if (name == known) {
      record.*member = value;
      return;
    }
  for (const auto& [known, member] : named.of_input)
    if (name.starts_with(known)) {
      record.inputs[name.substr(known.size())].*member = value;
      return;
    }
  (record.others.*named.all)[name] = value;
}

} // namespace

const InputRecord& TableRecord::input(const std::string& name) const {
  static const InputRecord nothing;
  const auto found = inputs.find(name);
  return found == inputs.end() ? nothing : found->second;
}

TableAttributes attributes_of(const TableRecord& record) {
  TableAttributes attributes = record.others;
  add(attributes, record, text_names);
  add(attributes, record, number_names);
  return attributes;
}

void take_attribute(TableRecord& record, const std::string& name, const std::string& text) {
  take(record, name, text, text_names);
}

void take_attribute(TableRecord& record, const std::string& name, double number) {
  take(record, name, number, number_names);
}

} // namespace frictab::table
