// Examines only names, shapes and types; single values are read with the description.
#include "data/hdf5_plan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/computed.h"
#include "data/quantity.h"
#include "io/csv.h"

namespace frictab::data {

namespace {

// Names of the columns that the job, or the program itself, takes from a file.
class AskedFor {
public:
  explicit AskedFor(const DataOptions& options) : options_(options) {
    for (const Quantity& quantity : quantities())
      if (!options.columns.count(quantity.name) && !options.constants.count(quantity.name))
        names_.insert(quantity.name);
    for (const auto& [canonical, source] : options.columns)
      names_.insert(source.names.begin(), source.names.end());
    if (options.experiment.empty()) names_.insert("experiment");
    names_.insert(experiment_column_of(options));
    names_.insert(origin_column);
    if (options.bystanders) names_.insert(options.bystanders->begin(), options.bystanders->end());
  }

  bool has(const std::string& name) const {
    const auto [known, is_new] = known_.emplace(name, false); // each test has the same names
    if (is_new)
      known->second = names_.count(name) > 0 || names_.count(io::read_header_name(name).name) > 0 ||
                      !computed_from(options_, name).empty();
    return known->second;
  }

  std::optional<std::string> first_of(const std::vector<std::string>& columns) const {
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const std::string& name) { return has(name); });
    return found == columns.end() ? std::nullopt : std::optional(*found);
  }

private:
  const DataOptions& options_;
  std::set<std::string> names_;
  mutable std::map<std::string, bool> known_;
};

// Parts that are not read, each listed once for all groups.
class LeftOut {
public:
  void add(const std::string& group, const std::string& name, const std::string& what) {
    const auto [known, is_new] =
        index_.emplace(std::tuple(group.empty(), name, what), things_.size());
    if (is_new) things_.push_back({hdf5_path(group, name), name, what, 0});
    ++things_[known->second].groups;
  }

  std::string text() const {
    constexpr std::size_t shown = 20;
    std::vector<std::string> texts;
    for (const Thing& thing : things_)
      if (texts.size() < shown)
        texts.push_back(fmt::format(
            "'{}' ({}){}", thing.groups > 1 ? thing.name : thing.path, thing.what,
            thing.groups > 1 ? fmt::format(" in {} groups", thousands(thing.groups)) : ""));
    return join(texts, ", ") + and_more(things_.size() - texts.size(), "thing");
  }

  bool empty() const { return things_.empty(); }

private:
  struct Thing {
    std::string path, name, what;
    std::size_t groups;
  };
  std::vector<Thing> things_;
  std::map<std::tuple<bool, std::string, std::string>, std::size_t> index_;
};

class Planner {
public:
  Planner(const io::Hdf5Reader& in, const std::string& named, const DataOptions& options,
          FaultList& faults)
      : in_(in), named_(named), asked_(options), faults_(faults) {}

  Hdf5Plan plan() {
    std::vector<Hdf5Rows> tests;
    for (const std::string& group : in_.groups())
      tests.push_back(columns_of(group, true));
    const bool any_test = std::any_of(tests.begin(), tests.end(),
                                      [](const Hdf5Rows& test) { return !test.columns.empty(); });
    Hdf5Rows root = columns_of("", !any_test);
    Hdf5Plan plan;
    plan.per_test = is_per_test(root, tests);
    if (plan.per_test)
      take_tests(std::move(tests), plan);
    else
      take_root(std::move(root), plan);
    refuse_without_rows(plan);
    if (!left_.empty()) plan.notes.push_back("HDF5 content that is not read: " + left_.text());
    return plan;
  }

private:
  std::size_t length(const std::string& path) const {
    return io::length_of_column(in_.shape(path)).value_or(0);
  }

  std::vector<std::string> datasets(const std::string& group) const {
    return in_.datasets(group.empty() ? "/" : group);
  }

  // True for datasets of one value, which MATLAB writes as 1 x 1.
  bool is_single(const std::string& path) const {
    const std::vector<std::size_t> shape = in_.shape(path);
    return shape.empty() || (shape.size() > 1 && io::length_of_column(shape) == 1);
  }

  bool may_be_column(const std::string& path) const {
    return in_.other_type(path).empty() && io::length_of_column(in_.shape(path)).has_value();
  }

  // The columns of the length of the first requested one. `one_row`: single values form columns of
  // one row if the group has no other columns.
  Hdf5Rows columns_of(const std::string& group, bool one_row) const {
    Hdf5Rows rows{group, 0, {}, {}};
    std::vector<std::string>& names = rows.columns;
    const auto is_one = [&](const std::string& name) { return is_single(hdf5_path(group, name)); };
    for (const std::string& name : datasets(group))
      if (may_be_column(hdf5_path(group, name))) names.push_back(name);
    if (!std::all_of(names.begin(), names.end(), is_one) || !one_row || !asked_.first_of(names))
      std::erase_if(names, is_one);
    if (names.empty()) return rows;
    rows.count = length(hdf5_path(group, asked_.first_of(names).value_or(names.front())));
    std::erase_if(names, [&](const std::string& name) {
      return length(hdf5_path(group, name)) != rows.count;
    });
    return rows;
  }

  bool is_per_test(const Hdf5Rows& root, const std::vector<Hdf5Rows>& tests) const {
    if (root.columns.empty()) return !tests.empty();
    const auto of_root = asked_.first_of(root.columns);
    for (const Hdf5Rows& test : tests) {
      const auto of_test = asked_.first_of(test.columns);
      if (of_test && of_root)
        throw InputError(
            {named_, 0, 0},
            fmt::format("holds the column '{}' and groups with columns ('{}'): either could be "
                        "the campaign",
                        *of_root, hdf5_path(test.group, *of_test)),
            "write the columns and the groups, one per test, to files of their own");
      if (of_test) return true;
    }
    return false;
  }

  void take_root(Hdf5Rows&& root, Hdf5Plan& plan) {
    const std::set<std::string> taken(root.columns.begin(), root.columns.end());
    root.singles = singles_of_root(root, taken);
    report_other_objects(root, true);
    for (const std::string& group : in_.groups())
      left_.add("", group, "a group");
    plan.groups.push_back(std::move(root));
  }

  void take_tests(std::vector<Hdf5Rows>&& tests, Hdf5Plan& plan) {
    std::set<std::string> taken;
    std::erase_if(tests, [&](const Hdf5Rows& test) {
      if (test.columns.empty()) left_.add("", test.group, "a group without columns");
      return test.columns.empty();
    });
    const std::map<std::string, std::size_t> values = count_values(tests);
    for (Hdf5Rows& test : tests) {
      test.singles = singles_of_test(test, [&](const std::string& name) {
        return asked_.has(name) || values.at(name) == tests.size();
      });
      taken.insert(test.columns.begin(), test.columns.end());
      for (const Hdf5Single& single : test.singles)
        taken.insert(single.name);
    }
    const std::vector<Hdf5Single> of_all = singles_of_root({}, taken);
    report_other_objects({}, false);
    for (Hdf5Rows& test : tests) {
      test.singles.insert(test.singles.end(), of_all.begin(), of_all.end());
      report_other_objects(test, true);
    }
    plan.groups = std::move(tests);
  }

  std::optional<Hdf5Single> single(const std::string& group, const std::string& name) const {
    const std::string path = hdf5_path(group, name);
    if (!is_single(path) || !in_.other_type(path).empty() || !in_.fault(path).empty())
      return std::nullopt;
    Hdf5Single one{name, in_.text_attribute(path, "units").value_or(""), 0.0};
    if (in_.is_text(path))
      one.value = in_.texts(path).front();
    else
      one.value = in_.values(path).front();
    return one;
  }

  std::vector<Hdf5Single> attributes_of(const std::string& object) const {
    std::vector<Hdf5Single> all;
    for (const std::string& name : in_.attributes(object))
      if (const auto number = in_.number_attribute(object, name))
        all.push_back({name, "", *number});
      else if (const auto text = in_.text_attribute(object, name))
        all.push_back({name, "", *text});
    return all;
  }

  // Number of tests that have each dataset of one value.
  std::map<std::string, std::size_t> count_values(const std::vector<Hdf5Rows>& tests) const {
    std::map<std::string, std::size_t> count;
    for (const Hdf5Rows& test : tests)
      for (const std::string& name : datasets(test.group))
        if (!is_column(test, name) && single(test.group, name)) ++count[name];
    return count;
  }

  // Reports the values that `is_read` refuses.
  template <class IsRead>
  std::vector<Hdf5Single> singles_of_test(const Hdf5Rows& test, const IsRead& is_read) {
    std::vector<Hdf5Single> all = attributes_of(test.group);
    for (const std::string& name : datasets(test.group)) {
      const auto one = is_column(test, name) ? std::nullopt : single(test.group, name);
      if (one && is_read(name))
        all.push_back(*one);
      else if (one)
        left_.add(test.group, name, "a single value, not in all tests");
    }
    return all;
  }

  // Requested single values that are not `taken` from elsewhere; reports the others.
  std::vector<Hdf5Single> singles_of_root(const Hdf5Rows& root,
                                          const std::set<std::string>& taken) {
    using Value = decltype(Hdf5Single::value);
    std::vector<Hdf5Single> all;
    const auto take = [&](const Hdf5Single& one, const char* what) {
      if (taken.count(one.name))
        left_.add("", one.name, fmt::format("{}, in addition to columns of that name", what));
      else if (asked_.has(one.name))
        all.push_back(one);
      else
        left_.add("", one.name, what);
    };
    for (const Hdf5Single& one : attributes_of("/"))
      if (one.name != "source" ||
          one.value != Value(std::string("frictab"))) // data/write_dataset.h
        take(one, "an attribute");
    for (const std::string& name : datasets(""))
      if (!is_column(root, name))
        if (const auto one = single("", name)) take(*one, "a single value");
    return all;
  }

  static bool is_column(const Hdf5Rows& rows, const std::string& name) {
    return std::binary_search(rows.columns.begin(), rows.columns.end(), name);
  }

  // Reports contents other than columns and single values. `read`: the columns of this group are
  // read.
  void report_other_objects(const Hdf5Rows& rows, bool read) {
    for (const io::Hdf5Other& other : in_.others(rows.group.empty() ? "/" : rows.group))
      leave(rows.group, other.name, other.what);
    for (const std::string& name : datasets(rows.group)) {
      const std::string path = hdf5_path(rows.group, name);
      if (is_column(rows, name) || single(rows.group, name)) continue;
      if (const std::string type = in_.other_type(path); !type.empty())
        leave(rows.group, name, type);
      else if (read && in_.shape(path).size() == 1)
        faults_.add(
            {named_, 0, 0},
            fmt::format(
                "column '{}' has {} rows, '{}' has {}", path, length(path),
                hdf5_path(rows.group, asked_.first_of(rows.columns).value_or(rows.columns.front())),
                rows.count));
      else if (in_.shape(path).empty())
        leave(rows.group, name, "a single value that cannot be read");
      else
        leave(rows.group, name, fmt::format("{} values", fmt::join(in_.shape(path), " x ")));
    }
  }

  void leave(const std::string& group, const std::string& name, const std::string& what) {
    if (asked_.has(name))
      faults_.add({named_, 0, 0},
                  fmt::format("'{}' is not a column: it is {}", hdf5_path(group, name), what),
                  "a column has a number or a text per row: n, n x 1 or 1 x n");
    else
      left_.add(group, name, what);
  }

  void refuse_without_rows(const Hdf5Plan& plan) const {
    for (const Hdf5Rows& rows : plan.groups)
      if (rows.count > 0) return;
    throw InputError({named_, 0, 0}, "holds no data columns",
                     "a data file has one dataset per column, or such groups: one per test" +
                         (left_.empty() ? "" : "; it holds " + left_.text()));
  }

  const io::Hdf5Reader& in_;
  const std::string& named_;
  AskedFor asked_;
  FaultList& faults_;
  LeftOut left_;
};

} // namespace

std::string hdf5_path(const std::string& group, const std::string& name) {
  return group.empty() ? name : group + "/" + name;
}

Hdf5Plan plan_hdf5(const io::Hdf5Reader& in, const std::string& named, const DataOptions& options,
                   FaultList& faults) {
  return Planner(in, named, options, faults).plan();
}

} // namespace frictab::data
