// The keys of study.toml.
#include "study/written_study.h"

#include <algorithm>

#include <fmt/format.h>

#include "study/toml_values.h"

namespace frictab::study {

using job::TomlNode;

namespace {

class WrittenReader {
public:
  WrittenReader(const std::string& file, FaultList& faults) : file_(file), faults_(faults) {}

  void read(TomlNode root) {
    Keys keys("", faults_);
    keys.text("job", written_.job);
    keys.text("directory", written_.directory);
    keys.take("stage", [&](const TomlNode& node) { read_stage(node); });
    keys.take("campaigns", [&](const TomlNode& node) {
      written_.list = text_of(node, "campaigns", faults_);
      written_.list_place = node.place;
    });
    keys.take("campaign", [&](const TomlNode& node) {
      for (const TomlNode* table : tables_of(node, "campaign", faults_))
        read_campaign(*table);
    });
    keys.take("twin", [&](const TomlNode& node) {
      for (const TomlNode* table : tables_of(node, "twin", faults_))
        read_twin(*table);
    });
    keys.read(root);
    if (!root.find("job"))
      faults_.add({file_, 0, 0}, "there is no job",
                  "write job = \"job.toml\": what all campaigns share");
  }

  WrittenStudy take() { return std::move(written_); }

private:
  void read_stage(const TomlNode& node) {
    const std::string name = text_of(node, "stage", faults_);
    if (const auto stage = stage_named(name))
      written_.stage = *stage;
    else if (!name.empty())
      faults_.add(node.place, fmt::format("there is no stage '{}'", name),
                  std::string("known: ") + stage_words);
  }

  void add_shared_keys(Keys& keys, WrittenCampaign& one, std::string& name) {
    keys.text("name", name);
    keys.texts("set", one.set);
    keys.take("factors", [&](const TomlNode& node) { read_factors(node, one); });
  }

  void read_campaign(const TomlNode& table) {
    WrittenCampaign one;
    one.place = table.place;
    Keys keys("campaign", faults_);
    add_shared_keys(keys, one, one.name);
    keys.texts("files", one.files);
    keys.texts("validation", one.validation);
    keys.read(table);
    written_.campaigns.push_back(std::move(one));
  }

  void read_factors(const TomlNode& node, WrittenCampaign& one) {
    if (node.type != TomlNode::Type::table) {
      faults_.add(node.place, "factors must be a table, not " + job::describe(node),
                  "write factors = { lubricant = \"...\", batch = \"7\" }");
      return;
    }
    for (const TomlNode& factor : node.items)
      if (factor.type == TomlNode::Type::text)
        one.factors.emplace_back(factor.key, factor.text);
      else if (factor.type == TomlNode::Type::whole || factor.type == TomlNode::Type::number)
        one.factors.emplace_back(factor.key, job::canonical_text(factor));
      else
        faults_.add(factor.place, fmt::format("factor {} must be a text or a number, not {}",
                                              factor.key, job::describe(factor)));
  }

  void read_twin(const TomlNode& table) {
    WrittenTwin twin;
    twin.shared.place = table.place;
    bool has_seed = false;
    Keys keys("twin", faults_);
    add_shared_keys(keys, twin.shared, twin.name);
    keys.take("seed", [&](const TomlNode& node) {
      twin.seeds = seeds_of(node, faults_);
      has_seed = true;
    });
    add_twin_keys(keys, twin.options, faults_);
    keys.read(table);
    finish_twin(table, twin.options, faults_);
    if (!has_seed) faults_.add(table.place, "[[twin]] has no seed", "write seed = \"1..1000\"");
    TomlNode words = table;
    std::erase_if(words.items, [](const TomlNode& item) {
      return item.key == "name" || item.key == "seed" || item.key == "set" || item.key == "factors";
    });
    twin.text = job::canonical_text(words);
    written_.twins.push_back(std::move(twin));
  }

  const std::string& file_;
  FaultList& faults_;
  WrittenStudy written_;
};

} // namespace

WrittenStudy read_written(std::string_view text, const std::string& file, FaultList& faults) {
  WrittenReader reader(file, faults);
  reader.read(job::parse_toml(text, file));
  return reader.take();
}

} // namespace frictab::study
