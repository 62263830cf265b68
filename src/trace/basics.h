// Names that every room of this floor uses.
#pragma once

#include <algorithm>
#include <functional>

#include <Eigen/Core>

namespace frictab::trace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Whether a list has an element with this value, or with this value of a member.
template <class List, class Value, class Member = std::identity>
bool contains(const List& list, const Value& value, Member member = {}) {
  return std::ranges::find(list, value, member) != std::ranges::end(list);
}

} // namespace frictab::trace
