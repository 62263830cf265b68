// Writes axes as data and literals, and sums over corners as statements in the order of the C
// kernels.
#include "codegen/fortran_interpolation.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/fixed_form.h"
#include "codegen/number_text.h"
#include "codegen/values_file.h"
#include "table/axis_search.h"
#include "table/spline.h"

namespace frictab::codegen::fortran {

using table::Table;

namespace {

using Strings = std::vector<std::string>;

std::vector<long> strides(const Table& table) {
  std::vector<long> out;
  long stride = static_cast<long>(table.nodes());
  for (const table::TableAxis& axis : table.axes)
    out.push_back(stride /= static_cast<long>(axis.nodes.size()));
  return out;
}

// Returns "tv(at+5)".
std::string value_at(long offset) {
  return offset == 0 ? "tv(at)" : fmt::format("tv(at+{})", offset);
}

// Writes the statements of ft_corners_N, depth first: p and q are the two ends on the last axis,
// "a" and "b" the two sides of the axis before.
void corners(const std::vector<long>& stride, std::size_t axis, long offset, char side,
             Strings& out) {
  const std::size_t number = axis + 1;
  const auto mix = [&](char name, const std::string& a, const std::string& b) {
    out.push_back(fmt::format("{0}{1}{2} = v{1}*{3} + w{1}*{4}", name, number, side, a, b));
  };
  if (axis + 2 == stride.size()) {
    mix('p', value_at(offset), value_at(offset + stride[axis]));
    mix('q', value_at(offset + 1), value_at(offset + stride[axis] + 1));
    return;
  }
  corners(stride, axis + 1, offset, 'a', out);
  corners(stride, axis + 1, offset + stride[axis], 'b', out);
  for (const char name : {'p', 'q'})
    mix(name, fmt::format("{}{}a", name, number + 1), fmt::format("{}{}b", name, number + 1));
}

Strings linear_steps(const std::vector<long>& stride, const std::string& result) {
  Strings out;
  const std::size_t axes = stride.size();
  if (axes == 1) return {result + " = v1*tv(at) + w1*tv(at+1)"};
  corners(stride, 0, 0, 'a', out);
  out.push_back(fmt::format("{1} = v{0}*p1a + w{0}*q1a", axes, result));
  return out;
}

Strings linear_names(std::size_t axes) {
  Strings out;
  for (std::size_t d = 1; d <= axes; ++d) {
    out.push_back(fmt::format("double precision w{0}, v{0}", d));
    if (d == axes) continue;
    out.push_back(fmt::format("double precision p{0}a, q{0}a", d));
    if (d > 1) out.push_back(fmt::format("double precision p{0}b, q{0}b", d));
  }
  return out;
}

// Returns the sum along axis `axis` of its support's coefficients, as in ft_rows: in pairs.
std::string rows(const Table& table, const std::vector<long>& stride, std::size_t axis,
                 const std::string& at, long offset) {
  const std::size_t n = table.axes[axis].nodes.size();
  const auto term = [&](long j) {
    return fmt::format("w({},{})*tv({}+l{:+})", j + 1, axis + 1, at, offset + j * stride[axis] - 1);
  };
  const std::string pair = term(0) + " + " + term(1);
  if (n == 2) return pair;
  if (n == 3) return fmt::format("({}) + {}", pair, term(2));
  return fmt::format("({}) + ({} + {})", pair, term(2), term(3));
}

// Writes the statements of ft_sum_N for axis `axis` and all further ones, into r(1..4), with the
// first coefficient at `at`. As in ft_sum_N, rows are added in pairs, further axes one coefficient
// after the other, and the last three axes are written out: gfortran makes the same vectors of the
// loop as of the C kernel, where a directive unrolls it.
void sums(const Table& table, const std::vector<long>& stride, std::size_t axis,
          const std::string& at, const std::string& indent, Strings& out) {
  const std::size_t n = table.axes[axis].nodes.size(), support = std::min<std::size_t>(n, 4);
  const std::size_t number = axis + 1;
  const auto line = [&](const std::string& text) { out.push_back(indent + text); };
  if (axis + 1 == stride.size()) {
    line("do l = 1, 4");
    line(fmt::format("  r(l) = tv({}+l-1)", at));
    line("end do");
    return;
  }
  if (axis + 3 >= stride.size()) {
    line("!GCC$ unroll 2");
    line("do l = 1, 4");
    if (axis + 2 == stride.size())
      line("  r(l) = " + rows(table, stride, axis, at, 0));
    else
      for (std::size_t j = 0; j < support; ++j)
        line(fmt::format("  acc = {} + w({},{})*({})", j == 0 ? "0.0D0" : "acc", j + 1, number,
                         rows(table, stride, axis + 1, at, static_cast<long>(j) * stride[axis])));
    if (axis + 3 == stride.size()) line("  r(l) = acc");
    line("end do");
    return;
  }
  line("do l = 1, 4");
  line(fmt::format("  s{}(l) = 0.0D0", number));
  line("end do");
  line(fmt::format("do j{} = 0, {}", number, support - 1));
  line(fmt::format("  i{0} = {1} + j{0}*{2}", number, at, stride[axis]));
  sums(table, stride, axis + 1, fmt::format("i{}", number), indent + "  ", out);
  line("  do l = 1, 4");
  line(fmt::format("    s{0}(l) = s{0}(l) + w(j{0}+1,{0})*r(l)", number));
  line("  end do");
  line("end do");
  line("do l = 1, 4");
  line(fmt::format("  r(l) = s{}(l)", number));
  line("end do");
}

Strings cubic_steps(const Table& table, const std::vector<long>& stride,
                    const std::string& result) {
  Strings out;
  sums(table, stride, 0, "at", "", out);
  out.push_back(fmt::format("{1} = (w(1,{0})*r(1) + w(2,{0})*r(2)) + (w(3,{0})*r(3) + "
                            "w(4,{0})*r(4))",
                            stride.size(), result));
  return out;
}

// Declarations for the value alone; the derivatives need `counters` as well.
Strings cubic_names(std::size_t axes) {
  Strings out{"double precision r(4)"};
  if (axes > 2) out.emplace_back("double precision acc");
  for (std::size_t d = 1; d + 3 <= axes; ++d)
    out.push_back(fmt::format("double precision s{}(4)", d));
  return out;
}

// `written_out`: number of last axes without a loop of their own.
Strings counters(std::size_t axes, std::size_t written_out) {
  Strings out;
  for (std::size_t d = 1; d + written_out <= axes; ++d)
    out.push_back(fmt::format("integer(8) i{0}, j{0}", d));
  return out;
}

std::vector<TemplateValues> statements(const Strings& lines) {
  std::vector<TemplateValues> out;
  for (const std::string& line : lines) {
    TemplateValues one;
    const std::size_t directive = line.find("!GCC$"); // stands in the first column
    one.text["text"] = directive == std::string::npos ? fixed_form(line) : line.substr(directive);
    out.push_back(one);
  }
  return out;
}

// Arrays of all axes, one axis after the other.
struct Data {
  std::vector<double> nodes, per_cell, basis;
  std::vector<int> guide, first;
};

void add_axis(TemplateValues& axis, const table::AxisSearch& search, long stride,
              const Data& data) {
  const std::size_t node = data.nodes.size() + 1, cell = data.per_cell.size() + 1;
  const std::size_t n = search.u.size();
  const auto text = [&](const char* name, std::size_t number) {
    axis.text[name] = std::to_string(number);
  };
  text("node", node);
  text("next_node", node + 1);
  text("last_node", node + n - 1);
  text("cells", n - 1);
  text("last_cell", n - 2);
  text("cell", cell);
  text("cell_before", cell - 1);
  text("guide", data.guide.size() + 1);
  axis.text["stride"] = std::to_string(stride);
  axis.text["scale"] = fortran_number(search.scale);
  axis.text["shift"] = fortran_number(search.shift);
  axis.flags = {{"one_cell", n == 2},
                {"scaled", n > 2 && search.scale > 0},
                {"guided", n > 2 && !search.guide.empty()},
                {"bisected", n > 2 && !(search.scale > 0)}};
}

// Returns how each axis is searched; adds the numbers of all axes to `data`.
std::vector<TemplateValues> search_axes(const Table& table, const std::vector<long>& stride,
                                        Data& data) {
  std::vector<TemplateValues> axes;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    const table::AxisSearch search = table::axis_search(table.axes[a].coordinates());
    axes.emplace_back();
    axes.back().text["number"] = std::to_string(a + 1);
    add_axis(axes.back(), search, stride[a], data);
    append(data.nodes, search.u);
    append(data.per_cell, search.per_cell);
    append(data.guide, search.guide);
    if (!is_cubic(table)) continue;
    const table::SplineAxis spline = table::spline_axis(table.axes[a]);
    append(data.first, spline.first);
    append(data.basis, spline.basis);
  }
  return axes;
}

std::string data_text(const Table& table, const Data& data, const std::vector<double>& baked,
                      bool in_file) {
  TemplateValues values;
  values.text = {{"n_nodes", std::to_string(data.nodes.size())},
                 {"n_cells", std::to_string(data.per_cell.size())},
                 {"n_guide", std::to_string(data.guide.size())},
                 {"n_basis", std::to_string(data.basis.size())},
                 {"n_values", std::to_string(baked.size())},
                 {"data_un", fixed_form_data("un", data.nodes)},
                 {"data_pc", fixed_form_data("pc", data.per_cell)},
                 {"data_gd", fixed_form_data("gd", data.guide)},
                 {"data_fc", fixed_form_data("fc", data.first)},
                 {"data_tb", fixed_form_data("tb", data.basis)},
                 {"data_tv", in_file ? "" : fixed_form_data("tv", baked)},
                 {"file", values_file_name},
                 {"value_comment", clip(baked_values_text(table, "coefficients of "))}};
  values.flags = {
      {"cubic", is_cubic(table)}, {"in_file", in_file}, {"uses_guide", !data.guide.empty()}};
  return render_part("fortran/frictab_data.f", values);
}

// One program unit: the value, its derivatives, or both, chosen by a flag.
struct Unit {
  bool value, slopes;
};

void add_steps(TemplateValues& values, const Table& table, const std::vector<long>& stride,
               Unit unit) {
  const bool cubic = is_cubic(table);
  const std::size_t axes = stride.size();
  const std::string result = unit.slopes ? "val" : "ftintp";
  Strings names, steps, slopes;
  const auto append = [](Strings& to, const Strings& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  if (!cubic || unit.value) append(names, cubic ? cubic_names(axes) : linear_names(axes));
  if (cubic) append(names, counters(axes, unit.slopes ? 2 : 3));
  if (unit.value) steps = cubic ? cubic_steps(table, stride, result) : linear_steps(stride, result);
  if (unit.slopes) {
    const Slopes all = cubic ? cubic_slopes(table, stride) : linear_slopes(stride);
    append(names, all.names);
    slopes = all.steps;
  }
  values.lists["names"] = statements(names);
  values.lists["steps"] = statements(steps);
  values.lists["slopes"] = statements(slopes);
  values.flags["slopes_asked"] = unit.slopes;
  values.flags["wrapped"] = unit.slopes && unit.value;
}

} // namespace

Piece interpolation(const ExportRequest& request, const std::vector<double>& baked, bool gradient,
                    Units units) {
  const Table& table = request.table;
  Piece out;
  if (table.is_direct() || table.axes.empty()) return out;
  const std::vector<long> stride = strides(table);
  Data data;
  TemplateValues values;
  values.lists["axes"] = search_axes(table, stride, data);
  out.data = data_text(table, data, baked, values_in_file(request));
  add_units(values, units);
  values.text["data"] = units == Units::external ? out.data : "";
  values.text["n_axes"] = std::to_string(table.axes.size());
  values.flags["cubic"] = is_cubic(table);
  values.flags["uses_bisection"] =
      std::any_of(values.lists["axes"].begin(), values.lists["axes"].end(),
                  [](const TemplateValues& axis) { return axis.flags.at("bisected"); });
  const auto add = [&](Unit unit) {
    add_steps(values, table, stride, unit);
    out.text += render_template("fortran/frictab_interpolation.f", values);
  };
  if (!gradient)
    add({true, false});
  else if (units == Units::external)
    add({true, true});
  else
    add({true, false}), add({false, true});
  out.text = without_last_break(out.text);
  return out;
}

} // namespace frictab::codegen::fortran
