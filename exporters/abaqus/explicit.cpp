// Statements, heads and build variants of the targets for Abaqus/Explicit.
#include "explicit.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/recipe.h"
#include "stop.h"

namespace frictab::abaqus {

namespace {

std::string fill(const std::string& pattern, std::size_t number) {
  return fmt::format(fmt::runtime(pattern), number);
}

// One temperature or field, read at each point.
TemplateValues given(const SolverInput& input, std::size_t index, const TemplateValues& filled,
                     const ExplicitNames& names) {
  const bool field = input.source == Source::field;
  const std::string first = field ? fill(names.field, input.field) : names.temperature;
  const std::string second =
      field ? (names.field_main.empty() ? "" : fill(names.field_main, input.field))
            : names.temperature_main;
  TemplateValues out;
  out.text = {{"index", std::to_string(index + 1)},
              {"comment", filled.text.at("comment")},
              {"exists", field ? fmt::format("{} .ge. {}", names.fields, input.field)
                               : std::string("nTemp .gt. 0")},
              {"first", first},
              {"second", second},
              {"second_exists", names.main + " .ge. 1"},
              {"fallback", filled.text.at("fallback")},
              {"property", std::to_string(input.property)},
              {"convert", filled.text.at("convert")}};
  out.flags = {{"has_second", !second.empty()},
               {"has_property", input.property > 0},
               {"converts", filled.flags.at("converts")}};
  return out;
}

BuildVariant variant(const std::string& name, const std::string& real, int dimension, double eps,
                     const std::string& file) {
  BuildVariant out;
  out.name = name;
  out.command = {"gfortran",
                 "-O2",
                 "-std=legacy",
                 "-ffixed-line-length-72",
                 "-ffp-contract=off",
                 "-fPIC",
                 "-shared",
                 "-I@{dir}",
                 "-o",
                 "@{out}",
                 "@{dir}/" + file};
  out.extra["vaba_param.inc"] =
      fmt::format("C     Stand-in for the solver's include, for tests outside the solver.\n"
                  "      implicit {} (a-h,o-z)\n"
                  "      parameter (j_sys_Dimension={}, n_vec_Length=136)\n"
                  "      parameter (maxblk=n_vec_Length)\n",
                  real, dimension);
  out.eps = eps;
  return out;
}

} // namespace

std::vector<BuildVariant> explicit_variants(const ExportRequest& request, const std::string& file) {
  std::vector<BuildVariant> all = {variant("double", "real*8", 2, 0x1p-53, file),
                                   variant("single", "real", 1, 0x1p-24, file)};
  if (fortran::ends(request))
    for (BuildVariant& one : all)
      add_stand_ins(one, Solver::explicit_);
  return all;
}

void add_compile(nlohmann::ordered_json& recipe, const std::string& file) {
  recipe["compile"] = {fmt::format("abaqus job=<job> user={} double=explicit", file),
                       fmt::format("abaqus job=<job> user={}", file), fixed_form_check(file)};
  recipe["compile_note"] =
      "the last line only checks the source, beside a vaba_param.inc of your own";
}

std::string explicit_head(const Exporter& exporter, const ExportRequest& request,
                          const std::vector<SolverInput>& inputs,
                          const std::vector<std::string>& remarks) {
  TemplateValues all, head;
  fortran::add_head(all, exporter, request, inputs, "XPLB_ABQERR ends the analysis",
                    directory_routine(Solver::explicit_));
  head.lists = all.lists;
  head.lists["remarks"] = fortran::comments(remarks);
  head.text = {{"version", all.text.at("version")},
               {"from", all.text.at("from")},
               {"n_props", std::to_string(property_count(inputs))}};
  return fortran::without_last_break(render_template("abaqus/explicit_head.f", head));
}

Lines only(const std::vector<SolverInput>& inputs, const SolverGives& gives,
           const std::vector<Source>& sources, const std::vector<std::string>& texts,
           const std::vector<std::string>& flags) {
  const Lines all = fortran_inputs(inputs, gives);
  Lines out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Source source = inputs.empty() ? Source::constant : inputs[i].source;
    if (std::find(sources.begin(), sources.end(), source) == sources.end()) continue;
    TemplateValues one;
    for (const std::string& name : texts)
      one.text[name] = all[i].text.at(name);
    for (const std::string& name : flags)
      one.flags[name] = all[i].flags.at(name);
    out.push_back(std::move(one));
  }
  return out;
}

std::string explicit_fixed(const std::vector<SolverInput>& inputs, const SolverGives& gives) {
  TemplateValues values;
  values.lists["inputs"] =
      only(inputs, gives, {Source::property, Source::constant},
           {"index", "comment", "fallback", "property", "convert"}, {"is_property", "converts"});
  if (values.lists["inputs"].empty()) return "";
  return fortran::without_last_break(render_template("abaqus/explicit_fixed.f", values));
}

std::string explicit_given(const std::vector<SolverInput>& inputs, const ExplicitNames& names) {
  const Lines filled = fortran_inputs(inputs, {{}, "property {}", "field {}"});
  TemplateValues values;
  Lines& list = values.lists["inputs"];
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].source == Source::temperature || inputs[i].source == Source::field)
      list.push_back(given(inputs[i], i, filled[i], names));
  if (list.empty()) return "";
  return fortran::without_last_break(render_template("abaqus/explicit_given.f", values));
}

bool needs_unknown(const std::vector<SolverInput>& inputs) {
  return std::any_of(inputs.begin(), inputs.end(), [](const SolverInput& input) {
    const bool asked = input.property > 0 || input.source == Source::field ||
                       input.source == Source::temperature || input.source == Source::constant;
    return asked && !input.fallback;
  });
}

} // namespace frictab::abaqus
