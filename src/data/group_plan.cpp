// Examines only names, shapes and types; single values are read with the description.
#include "data/group_plan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/computed.h"
#include "data/quantity.h"
#include "io/csv.h"
#include "io/hdf5.h"

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
    names_.insert(options.above.begin(), options.above.end());
    if (options.bystanders) names_.insert(options.bystanders->begin(), options.bystanders->end());
    for (const DropRule& rule : options.drop)
      names_.insert(rule.column);
  }

  // True for a name that the job or the program states, without regard to units.
  bool has_exactly(const std::string& name) const { return names_.count(name) > 0; }

  bool has(const std::string& name) const {
    const auto [known, is_new] = known_.emplace(name, false); // each test has the same names
    if (is_new)
      known->second = names_.count(name) > 0 || names_.count(io::read_header_name(name).name) > 0 ||
                      !computed_from(options_, name).empty();
    return known->second;
  }

  const io::GroupMember* first_of(const std::vector<io::GroupMember*>& columns) const {
    const auto found =
        std::find_if(columns.begin(), columns.end(),
                     [&](const io::GroupMember* column) { return has(column->name); });
    return found == columns.end() ? nullptr : *found;
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
    if (is_new) things_.push_back({member_path(group, name), name, what, 0});
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

bool is_column(const GroupRows& rows, const io::GroupMember& member) {
  return std::find(rows.columns.begin(), rows.columns.end(), &member) != rows.columns.end();
}

std::size_t length(const io::GroupMember& member) {
  return io::length_of_column(member.shape).value_or(0);
}

// True for members of one value, which MATLAB writes as 1 x 1.
bool is_single(const io::GroupMember& member) {
  return member.shape.empty() ||
         (member.shape.size() > 1 && io::length_of_column(member.shape) == 1);
}

std::optional<SingleValue> single(const io::GroupMember& member) {
  if (!is_single(member) || !member.other_type.empty() || !member.fault.empty() || !member.single)
    return std::nullopt;
  return SingleValue{member.name, member.unit, *member.single};
}

// Makes one group, or all, the root of the file (`one_group_is_file`).
class OneFile {
public:
  OneFile(io::ColumnGroups& all, const AskedFor& asked) : all_(all), asked_(asked) {}

  void gather() {
    if (!all_.one_group_is_file) return;
    if (std::any_of(all_.groups.begin(), all_.groups.end(),
                    [&](const io::ColumnGroup& group) { return is_asked_by_path(group); }))
      return flatten();
    if (std::any_of(all_.root.members.begin(), all_.root.members.end(), may_be_column)) return;
    if (io::ColumnGroup* const only = only_group()) move_up(*only);
  }

private:
  static bool may_be_column(const io::GroupMember& member) {
    return member.other_type.empty() && length(member) > 1;
  }

  static std::string dotted(const io::ColumnGroup& group, const io::GroupMember& member) {
    return group.name + "." + member.name;
  }

  bool is_asked_by_path(const io::ColumnGroup& group) const {
    return std::any_of(group.members.begin(), group.members.end(), [&](const auto& member) {
      return asked_.has_exactly(dotted(group, member));
    });
  }

  void flatten() {
    for (io::ColumnGroup& group : all_.groups)
      for (io::GroupMember& member : group.members) {
        member.name = dotted(group, member);
        all_.root.members.push_back(std::move(member));
      }
    all_.groups.clear();
    io::sort_by_name(all_);
  }

  io::ColumnGroup* only_group() const {
    for (const bool asked_ones : {true, false}) {
      std::vector<io::ColumnGroup*> found;
      for (io::ColumnGroup& group : all_.groups)
        if (std::any_of(group.members.begin(), group.members.end(),
                        [&](const io::GroupMember& member) {
                          return may_be_column(member) && (!asked_ones || asked_.has(member.name));
                        }))
          found.push_back(&group);
      if (!found.empty()) return found.size() == 1 ? found.front() : nullptr;
    }
    return nullptr;
  }

  void move_up(io::ColumnGroup& group) {
    std::erase_if(all_.root.members, [&](const io::GroupMember& member) {
      const bool twice = std::any_of(group.members.begin(), group.members.end(),
                                     [&](const auto& own) { return own.name == member.name; });
      if (twice) all_.root.others.push_back({member.name, "a value of the whole file"});
      return twice;
    });
    for (io::GroupMember& member : group.members)
      all_.root.members.push_back(std::move(member));
    all_.root.others.insert(all_.root.others.end(), group.others.begin(), group.others.end());
    all_.groups.erase(all_.groups.begin() + (&group - all_.groups.data()));
    io::sort_by_name(all_);
  }

  io::ColumnGroups& all_;
  const AskedFor& asked_;
};

class Planner {
public:
  Planner(io::ColumnGroups& in, const std::string& named, const DataOptions& options,
          FaultList& faults)
      : in_(in), named_(named), asked_(options), faults_(faults) {}

  GroupPlan plan() {
    OneFile(in_, asked_).gather();
    std::vector<GroupRows> tests;
    for (io::ColumnGroup& group : in_.groups)
      tests.push_back(columns_of(group, true));
    const bool any_test = std::any_of(tests.begin(), tests.end(),
                                      [](const GroupRows& test) { return !test.columns.empty(); });
    GroupRows root = columns_of(in_.root, !any_test);
    GroupPlan plan;
    plan.notes = in_.notes;
    plan.per_test = is_per_test(root, tests);
    if (plan.per_test)
      take_tests(std::move(tests), plan);
    else
      take_root(std::move(root), plan);
    refuse_without_rows(plan);
    plan.above = std::move(above_);
    if (!left_.empty())
      plan.notes.push_back(in_.format + " content that is not read: " + left_.text());
    return plan;
  }

private:
  // The columns of the length of the first requested one. `one_row`: single values form columns of
  // one row if the group has no other columns.
  GroupRows columns_of(io::ColumnGroup& group, bool one_row) const {
    GroupRows rows{&group, 0, {}, {}};
    std::vector<io::GroupMember*>& columns = rows.columns;
    const auto is_one = [](const io::GroupMember* member) { return is_single(*member); };
    for (io::GroupMember& member : group.members)
      if (member.other_type.empty() && io::length_of_column(member.shape))
        columns.push_back(&member);
    if (!std::all_of(columns.begin(), columns.end(), is_one) || !one_row ||
        !asked_.first_of(columns))
      std::erase_if(columns, is_one);
    if (columns.empty()) return rows;
    rows.count = length(first_column(rows));
    std::erase_if(columns,
                  [&](const io::GroupMember* member) { return length(*member) != rows.count; });
    return rows;
  }

  const io::GroupMember& first_column(const GroupRows& rows) const {
    const io::GroupMember* const asked = asked_.first_of(rows.columns);
    return asked ? *asked : *rows.columns.front();
  }

  bool is_per_test(const GroupRows& root, const std::vector<GroupRows>& tests) const {
    if (root.columns.empty()) return !tests.empty();
    const io::GroupMember* const of_root = asked_.first_of(root.columns);
    for (const GroupRows& test : tests) {
      const io::GroupMember* const of_test = asked_.first_of(test.columns);
      if (of_test && of_root)
        throw InputError(
            {named_, 0, 0},
            fmt::format("holds the column '{}' and groups with columns ('{}'): either could be "
                        "the campaign",
                        of_root->name, member_path(test.group->name, of_test->name)),
            "write the columns and the groups, one per test, to files of their own");
      if (of_test) return true;
    }
    return false;
  }

  void take_root(GroupRows&& root, GroupPlan& plan) {
    std::set<std::string> taken;
    for (const io::GroupMember* column : root.columns)
      taken.insert(column->name);
    root.singles = singles_of_root(root, taken);
    report_other_objects(root, true);
    for (const io::ColumnGroup& group : in_.groups)
      left_.add("", group.name, "a group");
    plan.groups.push_back(std::move(root));
  }

  void take_tests(std::vector<GroupRows>&& tests, GroupPlan& plan) {
    leave_groups(tests);
    std::set<std::string> taken;
    const std::map<std::string, std::size_t> values = count_values(tests);
    for (GroupRows& test : tests) {
      test.singles = singles_of_test(test, [&](const std::string& name) {
        return asked_.has(name) || values.at(name) == tests.size();
      });
      for (const io::GroupMember* column : test.columns)
        taken.insert(column->name);
      for (const SingleValue& one : test.singles)
        taken.insert(one.name);
    }
    const GroupRows no_rows{&in_.root, 0, {}, {}};
    const std::vector<SingleValue> of_all = singles_of_root(no_rows, taken);
    report_other_objects(no_rows, false);
    for (GroupRows& test : tests) {
      test.singles.insert(test.singles.end(), of_all.begin(), of_all.end());
      report_other_objects(test, true);
    }
    plan.groups = std::move(tests);
  }

  // Groups without columns are not tests. In a file of which one group may be all, groups without
  // requested columns are not either, if others have some.
  void leave_groups(std::vector<GroupRows>& tests) {
    const auto is_asked = [&](const GroupRows& test) { return asked_.first_of(test.columns); };
    const bool some_asked =
        in_.one_group_is_file && std::any_of(tests.begin(), tests.end(), is_asked);
    std::erase_if(tests, [&](const GroupRows& test) {
      const bool none = test.columns.empty(), others = some_asked && !is_asked(test);
      if (none) left_.add("", test.group->name, "a group without columns");
      if (!none && others) left_.add("", test.group->name, "a group without columns of the job");
      return none || others;
    });
  }

  static std::vector<SingleValue> values_of(const io::ColumnGroup& group) {
    std::vector<SingleValue> all;
    for (const io::GroupValue& one : group.values)
      all.push_back({one.name, "", one.value});
    return all;
  }

  // Number of tests that have each member of one value.
  static std::map<std::string, std::size_t> count_values(const std::vector<GroupRows>& tests) {
    std::map<std::string, std::size_t> count;
    for (const GroupRows& test : tests)
      for (const io::GroupMember& member : test.group->members)
        if (!is_column(test, member) && single(member)) ++count[member.name];
    return count;
  }

  // Reports the values that `is_read` refuses.
  template <class IsRead>
  std::vector<SingleValue> singles_of_test(const GroupRows& test, const IsRead& is_read) {
    std::vector<SingleValue> all = values_of(*test.group);
    for (const io::GroupMember& member : test.group->members) {
      const auto one = is_column(test, member) ? std::nullopt : single(member);
      if (one && is_read(member.name))
        all.push_back(*one);
      else if (one)
        left_.add(test.group->name, member.name, "a single value, not in all tests");
    }
    return all;
  }

  static std::string text_of(const SingleValue& one) {
    if (const auto* text = std::get_if<std::string>(&one.value)) return *text;
    const std::string number = shortest(std::get<double>(one.value));
    return one.unit.empty() ? number : number + " " + one.unit;
  }

  // Requested single values that are not `taken` from elsewhere; reports the others.
  std::vector<SingleValue> singles_of_root(const GroupRows& root,
                                           const std::set<std::string>& taken) {
    std::vector<SingleValue> all;
    const auto take = [&](const SingleValue& one, const char* what) {
      if (taken.count(one.name))
        left_.add("", one.name, fmt::format("{}, in addition to columns of that name", what));
      else if (asked_.has(one.name))
        all.push_back(one);
      else {
        left_.add("", one.name, what);
        above_.push_back({one.name, text_of(one)});
      }
    };
    for (const SingleValue& one : values_of(in_.root))
      if (one.name != "source" ||
          one.value != io::NumberOrText(std::string("frictab"))) // data/write_dataset.h
        take(one, "an attribute");
    for (const io::GroupMember& member : in_.root.members)
      if (!is_column(root, member))
        if (const auto one = single(member)) take(*one, "a single value");
    return all;
  }

  // Reports contents other than columns and single values. `read`: the columns of this group are
  // read.
  void report_other_objects(const GroupRows& rows, bool read) {
    const std::string& group = rows.group->name;
    for (const io::GroupOther& other : rows.group->others)
      leave(group, other.name, other.what);
    for (const io::GroupMember& member : rows.group->members) {
      if (is_column(rows, member) || single(member)) continue;
      if (!member.other_type.empty())
        leave(group, member.name, member.other_type);
      else if (read && member.shape.size() == 1)
        faults_.add({named_, 0, 0},
                    fmt::format("column '{}' has {} rows, '{}' has {}",
                                member_path(group, member.name), length(member),
                                member_path(group, first_column(rows).name), rows.count));
      else if (member.shape.empty())
        leave(group, member.name, "a single value that cannot be read");
      else
        leave(group, member.name, fmt::format("{} values", fmt::join(member.shape, " x ")));
    }
  }

  void leave(const std::string& group, const std::string& name, const std::string& what) {
    if (asked_.has(name))
      faults_.add({named_, 0, 0},
                  fmt::format("'{}' is not a column: it is {}", member_path(group, name), what),
                  "a column has a number or a text per row: n, n x 1 or 1 x n");
    else
      left_.add(group, name, what);
  }

  void refuse_without_rows(const GroupPlan& plan) const {
    for (const GroupRows& rows : plan.groups)
      if (rows.count > 0) return;
    throw InputError({named_, 0, 0}, "holds no data columns",
                     in_.form + (left_.empty() ? "" : "; it holds " + left_.text()));
  }

  io::ColumnGroups& in_;
  const std::string& named_;
  AskedFor asked_;
  FaultList& faults_;
  LeftOut left_;
  std::vector<io::CsvAbove> above_;
};

} // namespace

std::string member_path(const std::string& group, const std::string& name) {
  return group.empty() ? name : group + "/" + name;
}

GroupPlan plan_groups(io::ColumnGroups& all, const std::string& named, const DataOptions& options,
                      FaultList& faults) {
  return Planner(all, named, options, faults).plan();
}

} // namespace frictab::data
