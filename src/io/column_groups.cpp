// Columns in memory.
#include "io/column_groups.h"

#include <algorithm>

namespace frictab::io {

namespace {

template <class Named> void sort_names(std::vector<Named>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Named& a, const Named& b) { return a.name < b.name; });
}

} // namespace

GroupMember number_member(std::string name, std::string unit, std::vector<double> numbers) {
  GroupMember member;
  member.name = std::move(name);
  member.unit = std::move(unit);
  member.shape = {numbers.size(), 1};
  if (numbers.size() == 1) member.single = numbers.front();
  member.numbers = std::move(numbers);
  return member;
}

GroupMember text_member(std::string name, std::vector<std::string> texts) {
  GroupMember member;
  member.name = std::move(name);
  member.is_text = true;
  member.shape = {texts.size(), 1};
  if (texts.size() == 1) member.single = texts.front();
  member.texts = std::move(texts);
  return member;
}

void sort_by_name(ColumnGroups& all) {
  sort_names(all.groups);
  sort_names(all.root.members);
  for (ColumnGroup& group : all.groups)
    sort_names(group.members);
}

} // namespace frictab::io
