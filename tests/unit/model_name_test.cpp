// What a model says of itself, and what its name says where that is all there is.
#include <gtest/gtest.h>

#include "models/law.h"

namespace frictab::model_name_test {
namespace {

TEST(ModelName, SaysBaseQuantileAndEffects) {
  const models::Law* log_coulomb = models::find_law("log_coulomb");
  for (const bool traced : {false, true})
    for (const double quantile : {0.5, 0.05, 0.95}) {
      models::Law law = *log_coulomb;
      if (traced) law.base = law.name, law.name = models::traced_name(law.name);
      models::Model model;
      model.law = models::unregistered_law(law);
      model.quantile = quantile;
      EXPECT_EQ(model.base(), "log_coulomb");
      EXPECT_EQ(model.traced(), traced);
      const models::ModelName read = models::read_model_name(model.name(), {});
      EXPECT_EQ(read.base, log_coulomb) << model.name();
      EXPECT_EQ(read.traced, traced);
      EXPECT_EQ(read.quantile, quantile != 0.5);
    }
}

TEST(ModelName, OfNothingThatFrictabWritesHasNoBase) {
  for (const char* name : {"", "notes", "_q05", "_traced", "log_coulomb_q", "log_coulomb_qx",
                           "log_coulomb_q05_traced", "log_coulomb_traced_traced"})
    EXPECT_EQ(models::read_model_name(name, {}).base, nullptr) << name;
}

} // namespace
} // namespace frictab::model_name_test
