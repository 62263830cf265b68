// One description writes a record and reads it; what is damaged is refused with its path.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/json_fields.h"

namespace frictab::json_fields_test {

enum class Side { below, above };

struct End {
  Side side = Side::below;
  double value = 0;
};

struct Record {
  std::string name;
  std::size_t count = 0;
  double error = 0, known = 0;
  std::optional<double> factor;
  std::optional<End> end;
  std::string remark;
  bool exact = false;
  std::vector<double> curve;
  std::vector<End> ends;
};

static void describe(io::Fields& f, End& end) {
  f.one_of("side", end.side, {{"below", Side::below}, {"above", Side::above}});
  f("value", end.value);
}

static void describe(io::Fields& f, Record& r) {
  f("name", r.name);
  f("count", r.count);
  f("error", r.error);
  f.known("known", r.known);
  f("factor", r.factor);
  f.if_there("end", r.end);
  f.null_if_empty("remark", r.remark);
  f.unless_default("exact", r.exact);
  f("curve", r.curve);
  f("ends", r.ends);
  f.only_written("n_ends", r.ends.size());
}

namespace {

using testing::StartsWith;

constexpr const char* schema = "frictab/record/1";

std::string written(const Record& record) {
  return io::record_text(schema, [&](io::Fields& f) { describe(f, io::to_write(record)); });
}

Record read(const std::string& text) {
  Record record;
  io::read_record(text, "r.json", schema, "write it again",
                  [&](io::Fields& f) { describe(f, record); });
  return record;
}

Record whole() {
  return {"a", 3, 0.1, 2, 1.5, End{Side::above, 4}, "why", true, {1, 2}, {{}, {Side::above, 5}}};
}

std::string fault_of(const nlohmann::ordered_json& damaged) {
  try {
    read(damaged.dump());
  } catch (const InputError& error) {
    return error.what();
  }
  return "was taken";
}

TEST(JsonFields, WhatIsWrittenReadsBackAndSaysTheSame) {
  Record bare;
  bare.error = std::numeric_limits<double>::infinity();
  bare.curve = {1, std::nan("")};
  for (const Record& record : {whole(), bare})
    EXPECT_EQ(written(read(written(record))), written(record));
  EXPECT_TRUE(std::isnan(read(written(bare)).error));
  EXPECT_EQ(read(written(whole())).ends[1].side, Side::above);
}

TEST(JsonFields, FieldsStandInTheOrderOfTheDescriptionAndWhatIsNotThereIsNullOrAbsent) {
  auto json = nlohmann::ordered_json::parse(written({}));
  json.erase("tool_version");
  EXPECT_EQ(json.dump(), "{\"schema\":\"frictab/record/1\",\"name\":\"\",\"count\":0,\"error\":0.0,"
                         "\"known\":0.0,\"factor\":null,\"remark\":null,\"curve\":[],\"ends\":[],"
                         "\"n_ends\":0}");
}

TEST(JsonFields, AFaultNamesFilePathAndWhatMendsIt) {
  const auto good = nlohmann::ordered_json::parse(written(whole()));
  ASSERT_EQ(fault_of(good), "was taken");
  const std::vector<std::tuple<const char*, nlohmann::ordered_json, const char*>> damages = {
      {"/name", 5, "name: type must be string, but is number"},
      {"/count", -1, "count: -1 is not a count"},
      {"/known", nullptr, "known: type must be number, but is null"},
      {"/factor", "x", "factor: type must be number, but is string"},
      {"/ends/1", {{"side", "above"}}, "ends/1: key 'value' not found"},
      {"/ends/1/value", "x", "ends/1/value: type must be number, but is string"},
      {"/end/side", "aside", "end: side 'aside' is none of below, above"}};
  for (const auto& [place, damage, fault] : damages) {
    auto bad = good;
    bad[nlohmann::ordered_json::json_pointer(place)] = damage;
    EXPECT_EQ(fault_of(bad), std::string("r.json: error: not as frictab writes it: ") + fault +
                                 "\n  hint: write it again");
  }
  auto bad = good;
  bad.erase("name");
  EXPECT_THAT(fault_of(bad), StartsWith("r.json: error: not as frictab writes it: key 'name' not"));
}

} // namespace
} // namespace frictab::json_fields_test
