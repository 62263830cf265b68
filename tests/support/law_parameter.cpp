// Names of laws for INSTANTIATE_TEST_SUITE_P.
#include "support/law_parameter.h"

#include <algorithm>
#include <set>

#include "models/law.h"

namespace frictab::test {

std::vector<std::string> laws_by_formula() {
  std::vector<std::string> names;
  std::set<std::string> formulas;
  for (const models::Law& law : models::all_laws())
    if (formulas.insert(law.formula).second) names.push_back(law.name);
  return names;
}

std::string law_test_name(const testing::TestParamInfo<std::string>& law) {
  std::string name = law.param;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

} // namespace frictab::test
