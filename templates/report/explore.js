// The page's state is one object, `view`; every control changes it and calls show(). Plots read
// view and data, nothing else.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const get = (id) => document.getElementById(id);
const stateNamed = Object.fromEntries(data.states.map((state) => [state.name, state]));
const sigma = "sigma_n_MPa";
const points_of_a_curve = 161, map_columns = 64, map_rows = 48, far = 0.25, enough_tests = 0.499;

// ---- laws ----

const law_colours = ["#c2410c", "#2563a8", "#0f8a7e", "#8b3fd9", "#a16207", "#be185d", "#4d7c0f",
  "#0e7490"];
const dashes = [[], [9, 4], [2, 3]];
const colour_of = (law) =>
  data.laws[law].reference ? "#7f8a96" : law_colours[law % law_colours.length];
const dash_of = (law) => dashes[Math.floor(law / law_colours.length) % dashes.length];

const tau_of = (law, at) => laws[law](...data.laws[law].inputs.map((name) => at[name]));
const shown_quantity = (tau, at) => (view.quantity === "mu" ? tau / at[sigma] : tau);
const known_test = (law, test) => data.laws[law].inputs.every((name) => name in test.states);

// The states of each row of a test by name, made once.
for (const test of data.tests)
  test.rows = test.tau.map((_, i) =>
    Object.fromEntries(Object.entries(test.states).map(([name, values]) => [name, values[i]])));
const row_of = (test, i) => test.rows[i];
function mean(values) {
  const known = values.filter(Number.isFinite); // null: not known
  return known.reduce((sum, value) => sum + value, 0) / known.length;
}

// ---- the view, kept in the address ----

const first_varying = data.states.filter((state) => state.low < state.high && !state.levels);
const has_sigma = sigma in stateNamed;
const view = {
  quantity: "tau",
  along: has_sigma ? sigma : (first_varying[0] || data.states[0] || {name: ""}).name,
  across: "",
  law: Math.max(0, data.laws.findIndex((law) => law.name === data.recommended)),
  shown: new Set(data.laws.map((_, law) => law).filter((law) => law < 4 && !data.laws[law].reference)),
  at: Object.fromEntries(data.states.map((state) => [state.name, state.middle])),
  test: -1,
  marked: new Set(),
};
view.across = (first_varying.find((state) => state.name !== view.along) || {name: ""}).name;
view.shown.add(view.law);

function read_address() {
  const words = new URLSearchParams(location.hash.slice(1));
  const law_at = (name) => data.laws.findIndex((law) => law.name === name);
  for (const key of ["along", "across"])
    if (words.get(key) in stateNamed) view[key] = words.get(key);
  if (has_sigma && ["tau", "mu"].includes(words.get("quantity"))) view.quantity = words.get("quantity");
  if (law_at(words.get("law")) >= 0) view.law = law_at(words.get("law"));
  if (words.has("laws"))
    view.shown = new Set(words.get("laws").split(",").map(law_at).filter((law) => law >= 0));
  for (const state of data.states) {
    const value = Number(words.get("at." + state.name) || NaN);
    if (Number.isFinite(value)) view.at[state.name] = value;
  }
  view.test = data.tests.findIndex((test) => test.name === words.get("test"));
  view.marked = new Set((words.get("marked") || "").split(",")
    .map((name) => data.tests.findIndex((test) => test.name === name)).filter((test) => test >= 0));
}

function write_address() {
  const words = new URLSearchParams({quantity: view.quantity, along: view.along,
    across: view.across, law: data.laws[view.law].name,
    laws: [...view.shown].map((law) => data.laws[law].name).join(",")});
  for (const name in view.at) words.set("at." + name, String(view.at[name]));
  if (view.test >= 0) words.set("test", data.tests[view.test].name);
  if (view.marked.size)
    words.set("marked", [...view.marked].map((test) => data.tests[test].name).join(","));
  history.replaceState(null, "", "#" + words);
}

// ---- scales ----

const coordinate = (state, value) => (state.log ? Math.log(value) : value);
const from_coordinate = (state, u) => (state.log ? Math.exp(u) : u);
const value_at = (state, share, low = state.low, high = state.high) =>
  from_coordinate(state, coordinate(state, low) +
    share * (coordinate(state, high) - coordinate(state, low)));
const share_at = (state, value, low = state.low, high = state.high) =>
  (coordinate(state, value) - coordinate(state, low)) /
  (coordinate(state, high) - coordinate(state, low));
const digits = (value, count = 4) =>
  value === null || !Number.isFinite(value) ? "–" : String(Number(value.toPrecision(count)));
// Nodes of the law's table, or nothing.
const nodes_of = (name) => (data.nodes[data.laws[view.law].name] || {})[name] || [];
// The tests' range, and the table's where it reaches further.
function range_of(state) {
  const all = [state.low, state.high, ...nodes_of(state.name)];
  const low = Math.min(...all), high = Math.max(...all);
  return [state.log && !(low > 0) ? state.low : low, high];
}

// ---- controls ----

const element = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};

function fill(select, options, chosen) {
  select.replaceChildren(...options.map(([value, text]) => element("option", {value, textContent: text})));
  select.value = chosen;
}

function make_controls() {
  fill(get("quantity"), has_sigma ? [["tau", "τ_R / MPa"], ["mu", "μ = τ_R / σ_N"]]
    : [["tau", "τ_R / MPa"]], view.quantity);
  const labels = data.states.filter((state) => state.low < state.high && !state.levels)
    .map((state) => [state.name, state.label]);
  fill(get("along"), labels, view.along);
  fill(get("across"), labels, view.across);
  fill(get("law"), data.laws.map((law, i) => [i, law.name]), view.law);
  fill(get("test"), [[-1, "none"], ...data.tests.map((test, i) => [i, test.name])], view.test);
  for (const id of ["quantity", "along", "across"])
    get(id).onchange = () => {
      view[id] = get(id).value;
      get("from").value = get("to").value = ""; // of the axis before
      show(true);
    };
  for (const id of ["law", "test"])
    get(id).onchange = () => { view[id] = Number(get(id).value); show(true); };
  for (const id of ["from", "to"]) get(id).onchange = mark_range;
  get("clear").onclick = () => { get("from").value = get("to").value = ""; mark_range(); };
  data.laws.forEach((law, i) => {
    const box = element("input", {type: "checkbox", checked: view.shown.has(i)});
    box.onchange = () => { view.shown[box.checked ? "add" : "delete"](i); show(true); };
    const key = element("span", {className: "key"});
    key.style.borderColor = colour_of(i);
    get("laws").append(element("label", {title: law.title}, box, key, `${law.name} ${law.error}`));
  });
  for (const state of data.states) get("states").append(state_control(state));
}

// "σ_N / MPa" with N as an index.
function label_of(state) {
  const parts = /^([^\s_]+)_(\w+)( \/ .*)$/.exec(state.label);
  return parts ? [parts[1], element("sub", {textContent: parts[2]}), parts[3]] : [state.label];
}

function state_control(state) {
  const box = element("div", {className: "state"});
  if (state.levels) {
    const select = element("select", {className: "wide"});
    fill(select, state.levels.map((level, i) => [i, level]), Math.round(view.at[state.name]));
    select.setAttribute("aria-label", state.label);
    select.onchange = () => { view.at[state.name] = Number(select.value); show(); };
    view.at[state.name] = Math.round(view.at[state.name]);
    box.append(element("span", {}, ...label_of(state)), select);
    return box;
  }
  const slider = element("input", {type: "range", min: 0, max: 1000, step: 1});
  const exact = element("input", {type: "number", step: "any"});
  slider.setAttribute("aria-label", state.label);
  exact.setAttribute("aria-label", state.label + ", exact");
  const put = () => {
    slider.value = 1000 * share_at(state, view.at[state.name]);
    exact.value = digits(view.at[state.name], 8);
  };
  slider.disabled = !(state.low < state.high);
  slider.oninput = () => {
    view.at[state.name] = Number(digits(value_at(state, slider.value / 1000), 4));
    exact.value = view.at[state.name];
    show();
  };
  exact.onchange = () => {
    const value = Number(exact.value);
    if (exact.value !== "" && Number.isFinite(value) && !(state.log && value <= 0))
      view.at[state.name] = value;
    put();
    show();
  };
  put();
  box.append(element("span", {}, ...label_of(state),
    `, tested ${digits(state.low, 3)} to ${digits(state.high, 3)}`), slider, exact);
  return box;
}

// ---- plots along one state, by uPlot ----

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
// The scale of a state: from end to end, with ticks at 1, 2 and 5 where it is logarithmic.
function scale_of(state, low, high) {
  const reach = state.log ? Math.log(high / low) / 40 : (high - low) / 40;
  const range = state.log ? [low * Math.exp(-reach), high * Math.exp(reach)] : [low - reach, high + reach];
  return {time: false, distr: state.log ? 3 : 1, range: low < high ? range : undefined};
}
function state_axis(state, more = "") {
  const made = axis(state.label + more);
  if (state.log) {
    made.splits = (_, __, low, high) => {
      const ticks = [];
      for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
        for (const factor of [1, 2, 5]) ticks.push(factor * 10 ** power);
      return ticks.filter((tick) => tick >= low && tick <= high);
    };
    made.filter = (_, splits) => splits;
    made.values = (_, splits) => splits.map((tick) => digits(tick));
  }
  return made;
}
const axis = (label) => ({label, stroke: css("--ink"), grid: {stroke: css("--line")},
  ticks: {stroke: css("--line")}, labelSize: 24, size: label ? 56 : 40});
const quantity_label = () => (view.quantity === "mu" ? "μ" : "τ_R / MPa");

function size_of(host, height) {
  return {width: Math.max(host.clientWidth, 280), height};
}

function dot(u, x, y, radius) {
  const context = u.ctx, px = u.valToPos(x, "x", true), py = u.valToPos(y, "y", true);
  if (px < u.bbox.left || px > u.bbox.left + u.bbox.width || py < u.bbox.top ||
      py > u.bbox.top + u.bbox.height) return;
  context.moveTo(px + radius, py);
  context.arc(px, py, radius, 0, 7);
}

const emphasised = (test) => view.marked.has(test) || view.test === test;

// Rows of all tests, the marked ones on top.
function draw_rows(u) {
  const context = u.ctx;
  for (const strong of [false, true]) {
    context.beginPath();
    data.tests.forEach((test, t) => {
      if (emphasised(t) !== strong || !(view.along in test.states)) return;
      test.tau.forEach((tau, i) => {
        const at = row_of(test, i), y = shown_quantity(tau, at);
        if (Number.isFinite(y) && at[view.along] !== null)
          dot(u, at[view.along], y, (strong ? 2.6 : 1.6) * devicePixelRatio);
      });
    });
    context.fillStyle = strong ? css("--mark") : "#7f8a9666";
    context.fill();
  }
}

// Grey where no test has been, ticks at the table's nodes, a line at the state of the sliders.
function draw_ground(u) {
  const context = u.ctx, state = stateNamed[view.along], {left, top, width, height} = u.bbox;
  const at = (value) => Math.min(Math.max(u.valToPos(value, "x", true), left), left + width);
  context.fillStyle = css("--beyond");
  context.fillRect(left, top, at(state.low) - left, height);
  context.fillRect(at(state.high), top, left + width - at(state.high), height);
  context.fillStyle = css("--soft");
  for (const node of nodes_of(view.along))
    context.fillRect(at(node) - 0.5, top + height - 7 * devicePixelRatio, 1, 7 * devicePixelRatio);
  context.fillStyle = css("--accent");
  context.fillRect(at(view.at[view.along]) - 0.5, top, 1, height);
}

function curve_data() {
  const state = stateNamed[view.along], [low, high] = range_of(state);
  const x = [], at = {...view.at};
  for (let i = 0; i < points_of_a_curve; ++i)
    x.push(value_at(state, i / (points_of_a_curve - 1), low, high));
  const along = (law) => x.map((value) => {
    at[view.along] = value;
    return shown_quantity(tau_of(law, at), at);
  });
  const curves = data.laws.map((_, law) => (view.shown.has(law) || law === view.law ? along(law) : null));
  const band = data.laws[view.law].band;
  const edge = (k) => (band ? curves[view.law].map((y) => y * band[k]) : x.map(() => null));
  return [x, ...curves.map((curve, law) => (view.shown.has(law) ? curve : x.map(() => null))),
    edge(0), edge(1)];
}

// The range that holds 98 % of the rows of all tests.
function range_of_rows() {
  const values = data.tests.flatMap((test) => test.rows.map((at, i) => shown_quantity(test.tau[i], at)))
    .filter(Number.isFinite).sort((a, b) => a - b);
  return [values[Math.floor(0.01 * values.length)], values[Math.ceil(0.99 * values.length) - 1]];
}

let curves_plot = null, tests_plot = null, stroke_plot = null;

function make_curves() {
  if (curves_plot) curves_plot.destroy();
  const state = stateNamed[view.along], host = get("curves"), count = data.laws.length;
  const edge = {stroke: "transparent", width: 0, points: {show: false}};
  const [rows_low, rows_high] = range_of_rows();
  const all_of_it = (_, low, high) => {
    const bottom = Math.min(low, rows_low), top = Math.max(high, rows_high);
    return [bottom - 0.04 * (top - bottom), top + 0.04 * (top - bottom)];
  };
  curves_plot = new uPlot({
    ...size_of(host, 380),
    scales: {x: scale_of(state, ...range_of(state)), y: {range: all_of_it}},
    axes: [state_axis(state), axis(quantity_label())],
    cursor: {drag: {x: false, y: false}, points: {show: false}},
    series: [{}, ...data.laws.map((law, i) => ({label: law.name, stroke: colour_of(i),
      width: i === view.law ? 3 : 1.6, dash: dash_of(i), points: {show: false}})), edge, edge],
    bands: [{series: [count + 2, count + 1], fill: colour_of(view.law) + "22"}],
    hooks: {drawClear: [draw_ground], draw: [draw_rows]},
  }, curve_data(), host);
  curves_plot.over.onclick = (event) => choose_nearest(event, curves_plot, (test) =>
    test.tau.map((tau, i) => [test.states[view.along] && test.states[view.along][i],
      shown_quantity(tau, row_of(test, i))]));
}

function choose_nearest(event, plot, points) {
  let nearest = 12;
  data.tests.forEach((test, t) => {
    for (const [x, y] of points(test, t)) {
      const distance = Math.hypot(plot.valToPos(x, "x") - event.offsetX,
        plot.valToPos(y, "y") - event.offsetY);
      if (distance < nearest) { nearest = distance; view.test = t; }
    }
  });
  get("test").value = view.test;
  show(true);
}

// ---- tests ----

function mean_residual(test) {
  if (!known_test(view.law, test)) return NaN;
  return mean(test.tau.map((tau, i) => tau - tau_of(view.law, row_of(test, i))));
}

let test_points = []; // the tests as drawn

// Marks the tests whose mean along the axis lies in the range that the two fields give.
function mark_range() {
  const [from, to] = ["from", "to"].map((id) => get(id).value), given = from !== "" || to !== "";
  const inside = ({x}) => given && (from === "" || x >= Number(from)) && (to === "" || x <= Number(to));
  view.marked = new Set(test_points.filter(inside).map((point) => point.t));
  show(true);
}

function make_tests() {
  if (tests_plot) tests_plot.destroy();
  const state = stateNamed[view.along], host = get("tests");
  test_points = data.tests.map((test, t) => ({t, x: state && state.name in test.states
    ? mean(test.states[state.name]) : t, y: mean_residual(test)}))
    .filter((point) => Number.isFinite(point.y)).sort((a, b) => a.x - b.x);
  const column = (keep) => test_points.map((point) => (keep(point.t) ? point.y : null));
  const series = (label, stroke, fill, keep) => ({keep, label, stroke, paths: () => null,
    points: {show: true, size: 8, stroke, fill}});
  const all = [
    series("trained on", "#2563a8", css("--ground"), (t) => !data.tests[t].held_out && !emphasised(t)),
    series("held out", "#c2410c", "#c2410c", (t) => data.tests[t].held_out && !emphasised(t)),
    series("marked", css("--mark"), css("--mark"), emphasised)];
  tests_plot = new uPlot({
    ...size_of(host, 260),
    scales: {x: scale_of(state, Math.min(...test_points.map((point) => point.x)),
      Math.max(...test_points.map((point) => point.x)))},
    axes: [state_axis(state, ", mean of the test"), axis("residual / MPa")],
    cursor: {drag: {x: true, y: false, setScale: false}, points: {show: false}},
    series: [{}, ...all],
    hooks: {setSelect: [(u) => {
      if (u.select.width < 3) return;
      get("from").value = digits(u.posToVal(u.select.left, "x"));
      get("to").value = digits(u.posToVal(u.select.left + u.select.width, "x"));
      setTimeout(mark_range);
    }]},
  }, [test_points.map((point) => point.x), ...all.map((one) => column(one.keep))], host);
  tests_plot.over.onclick = (event) =>
    choose_nearest(event, tests_plot, (_, t) =>
      test_points.filter((point) => point.t === t).map((point) => [point.x, point.y]));
  get("marked").textContent = view.marked.size ? `${view.marked.size} of ${data.tests.length} marked` : "";
}

function make_stroke() {
  if (stroke_plot) stroke_plot.destroy();
  stroke_plot = null;
  const test = data.tests[view.test], rows = get("conditions").tBodies[0];
  rows.replaceChildren();
  if (!test) {
    get("stroke").textContent = "Choose a test above, or click one of its points.";
    return;
  }
  get("stroke").textContent = "";
  const over = ["s_mm", "time_s"].find((name) => name in test.states);
  const x = over ? test.states[over] : test.tau.map((_, i) => i);
  const predicted = known_test(view.law, test)
    ? test.tau.map((_, i) => tau_of(view.law, row_of(test, i))) : test.tau.map(() => null);
  const order = x.map((_, i) => i).sort((a, b) => x[a] - x[b]);
  const sorted = (values) => order.map((i) => values[i]);
  stroke_plot = new uPlot({
    ...size_of(get("stroke"), 240),
    scales: {x: {time: false}},
    axes: [axis(over ? stateNamed[over].label : "row"), axis("τ_R / MPa")],
    cursor: {points: {show: false}},
    series: [{}, {stroke: css("--mark"), width: 2}, {stroke: colour_of(view.law), width: 2, dash: [7, 4]}],
  }, [sorted(x), sorted(test.tau), sorted(predicted)], get("stroke"));
  const line = (name, value) => rows.append(element("tr", {}, element("th", {textContent: name}),
    element("td", {className: "num", textContent: value})));
  line("test", `${test.name}, ${test.held_out ? "held out" : "trained on"}`);
  line("mean residual, measured (solid) minus " + data.laws[view.law].name + " (dashed)",
    digits(mean_residual(test), 3) + " MPa");
  for (const name in test.states) {
    const values = test.states[name].filter(Number.isFinite), state = stateNamed[name];
    const low = Math.min(...values), high = Math.max(...values);
    line(state ? state.label : name, state && state.levels ? state.levels[values[0]]
      : low === high ? digits(low) : `${digits(low, 3)} to ${digits(high, 3)}`);
  }
}

// ---- the map ----

const ramp = [[253, 231, 37], [94, 201, 98], [33, 145, 140], [59, 82, 139], [68, 1, 84]];
function ramp_colour(share) {
  const x = Math.min(Math.max(share, 0), 1) * (ramp.length - 1), i = Math.min(Math.floor(x), ramp.length - 2);
  return ramp[i].map((c, k) => Math.round(c + (x - i) * (ramp[i + 1][k] - c)));
}

// Cells with half a test's worth of rows within a quarter of the tested span in every state of the
// law. The states off the map decide which rows count; each then covers a rectangle of cells.
function near_cells(x, y) {
  const span = (state) => coordinate(state, state.high) - coordinate(state, state.low);
  const others = data.laws[view.law].inputs.map((name) => stateNamed[name]).filter((state) =>
    state && state !== x.state && state !== y.state && state.low < state.high && !state.levels);
  const tests = new Float64Array(map_columns * map_rows); // tests' worth of rows near each cell
  const cells = (one, count, value) => {
    const reach = far * span(one.state), u = coordinate(one.state, value);
    const cell = (at) => (at - coordinate(one.state, one.low)) /
      (coordinate(one.state, one.high) - coordinate(one.state, one.low)) * count - 0.5;
    return [Math.max(0, Math.ceil(cell(u - reach))), Math.min(count - 1, Math.floor(cell(u + reach)))];
  };
  for (const test of data.tests) {
    if (!(x.state.name in test.states) || !(y.state.name in test.states)) continue;
    const share = 1 / test.tau.length;
    test.tau.forEach((_, i) => {
      for (const state of others)
        if (state.name in test.states &&
            Math.abs(coordinate(state, test.states[state.name][i]) -
              coordinate(state, view.at[state.name])) > far * span(state)) return;
      const [left, right] = cells(x, map_columns, test.states[x.state.name][i]);
      const [low, high] = cells(y, map_rows, test.states[y.state.name][i]);
      for (let row = low; row <= high; ++row)
        for (let column = left; column <= right; ++column)
          tests[row * map_columns + column] += share;
    });
  }
  return tests.map((near) => near >= enough_tests ? 1 : 0);
}

function map_values(x, y) {
  const values = new Float64Array(map_columns * map_rows), at = {...view.at};
  for (let row = 0; row < map_rows; ++row)
    for (let column = 0; column < map_columns; ++column) {
      at[x.state.name] = value_at(x.state, (column + 0.5) / map_columns, x.low, x.high);
      at[y.state.name] = value_at(y.state, (row + 0.5) / map_rows, y.low, y.high);
      values[row * map_columns + column] = shown_quantity(tau_of(view.law, at), at);
    }
  return values;
}

// Levels at multiples of 1, 2 or 5 times a power of ten, at most ten of them.
function levels_between(low, high) {
  if (!(high > low)) return [];
  const rough = (high - low) / 8, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= rough);
  const levels = [];
  for (let i = Math.ceil(low / step); i * step <= high; ++i) levels.push(i * step);
  return levels;
}

// Line segments of one level, by the triangles of each square of four cells.
function draw_level(context, values, level, place) {
  const corner = (column, row) => ({x: column, y: row, v: values[row * map_columns + column]});
  const cross = (a, b) => {
    const share = (level - a.v) / (b.v - a.v);
    return place(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
  };
  for (let row = 0; row + 1 < map_rows; ++row)
    for (let column = 0; column + 1 < map_columns; ++column) {
      const [a, b, c, d] = [corner(column, row), corner(column + 1, row), corner(column + 1, row + 1),
        corner(column, row + 1)];
      for (const triangle of [[a, b, c], [a, c, d]]) {
        const ends = [];
        triangle.forEach((one, i) => {
          const next = triangle[(i + 1) % 3];
          if ((one.v < level) !== (next.v < level)) ends.push(cross(one, next));
        });
        if (ends.length === 2) {
          context.moveTo(...ends[0]);
          context.lineTo(...ends[1]);
        }
      }
    }
}

function draw_map() {
  const canvas = get("map"), context = canvas.getContext("2d");
  const states = [stateNamed[view.along], stateNamed[view.across]];
  if (!states[0] || !states[1] || view.along === view.across) {
    canvas.height = 0;
    get("map-text").textContent = "A map needs two different states.";
    return;
  }
  const [x, y] = states.map((state) => {
    const [low, high] = range_of(state);
    return {state, low, high};
  });
  const scale = devicePixelRatio, wide = Math.max(canvas.clientWidth, 280), high = 340;
  canvas.width = wide * scale;
  canvas.height = high * scale;
  canvas.style.height = high + "px";
  context.setTransform(scale, 0, 0, scale, 0, 0);
  const box = {left: 64, top: 10, width: wide - 64 - 84, height: high - 10 - 46};
  const place_x = (value) => box.left + box.width * share_at(x.state, value, x.low, x.high);
  const place_y = (value) => box.top + box.height * (1 - share_at(y.state, value, y.low, y.high));
  const values = map_values(x, y), near = near_cells(x, y), finite = values.filter(Number.isFinite);
  const low = Math.min(...finite), most = Math.max(...finite);
  const cell_width = box.width / map_columns, cell_height = box.height / map_rows;
  const cells = new ImageData(map_columns, map_rows);
  for (let row = 0; row < map_rows; ++row)
    for (let column = 0; column < map_columns; ++column) {
      const value = values[row * map_columns + column];
      if (!Number.isFinite(value)) continue;
      const colour = ramp_colour(most > low ? (value - low) / (most - low) : 0.5);
      cells.data.set([...colour, 255], 4 * ((map_rows - 1 - row) * map_columns + column));
    }
  const small = element("canvas", {width: map_columns, height: map_rows});
  small.getContext("2d").putImageData(cells, 0, 0);
  context.imageSmoothingEnabled = false;
  context.drawImage(small, box.left, box.top, box.width, box.height);
  context.beginPath(); // hatching
  for (let cell = 0; cell < near.length; ++cell)
    if (!near[cell]) {
      const left = box.left + (cell % map_columns) * cell_width;
      const bottom = box.top + box.height - Math.floor(cell / map_columns) * cell_height;
      context.moveTo(left, bottom);
      context.lineTo(left + cell_width, bottom - cell_height);
    }
  context.strokeStyle = "#ffffffb0";
  context.lineWidth = 1;
  context.stroke();
  context.beginPath();
  const place = (column, row) => [box.left + (column + 0.5) * cell_width,
    box.top + box.height - (row + 0.5) * cell_height];
  const levels = levels_between(low, most);
  for (const level of levels) draw_level(context, values, level, place);
  context.strokeStyle = "#000000a0";
  context.stroke();
  draw_tested(context, box, place_x, place_y);
  draw_process(context, x, y, place_x, place_y);
  draw_frame(context, box, x, y, place_x, place_y);
  draw_scale(context, box, low, most, levels);
  const text = `${quantity_label()} of ${data.laws[view.law].name} over ${x.state.label} and ` +
    `${y.state.label}: ${digits(low, 3)} to ${digits(most, 3)}; ` +
    `${Math.round(100 * (1 - mean(Array.from(near))))} % of it is far from the tests`;
  canvas.setAttribute("aria-label", text);
  get("map-text").textContent = text + ". Dots: tested states; ticks inside the frame: nodes of the table" +
    (data.process[x.state.name] ? "; crosses: states of your process, by friction work." : ".");
}

// A cross for each state of the process that `frictab process` judged.
function draw_process(context, x, y, place_x, place_y) {
  const across = data.process[x.state.name], up = data.process[y.state.name];
  if (!across || !up) return;
  context.beginPath();
  across.forEach((value, i) => {
    if (value < x.low || value > x.high || up[i] < y.low || up[i] > y.high) return;
    const left = place_x(value), top = place_y(up[i]), arm = 3.5;
    context.moveTo(left - arm, top - arm);
    context.lineTo(left + arm, top + arm);
    context.moveTo(left - arm, top + arm);
    context.lineTo(left + arm, top - arm);
  });
  context.strokeStyle = "#c2410c";
  context.lineWidth = 1.4;
  context.stroke();
}

function draw_tested(context, box, place_x, place_y) {
  for (const strong of [false, true]) {
    context.beginPath();
    data.tests.forEach((test, t) => {
      if (emphasised(t) !== strong || !(view.along in test.states) || !(view.across in test.states)) return;
      test.tau.forEach((_, i) => {
        const px = place_x(test.states[view.along][i]), py = place_y(test.states[view.across][i]);
        context.moveTo(px + 1.5, py);
        context.arc(px, py, strong ? 2.4 : 1.3, 0, 7);
      });
    });
    context.fillStyle = strong ? "#ff2d87" : "#ffffffc0";
    context.fill();
  }
  const px = place_x(view.at[view.along]), py = place_y(view.at[view.across]);
  context.strokeStyle = "#fff";
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(px - 8, py); context.lineTo(px + 8, py);
  context.moveTo(px, py - 8); context.lineTo(px, py + 8);
  context.stroke();
}

function draw_frame(context, box, x, y, place_x, place_y) {
  context.strokeStyle = css("--soft");
  context.lineWidth = 1;
  context.strokeRect(box.left, box.top, box.width, box.height);
  context.beginPath();
  for (const node of nodes_of(x.state.name)) {
    context.moveTo(place_x(node), box.top + box.height);
    context.lineTo(place_x(node), box.top + box.height - 7);
  }
  for (const node of nodes_of(y.state.name)) {
    context.moveTo(box.left, place_y(node));
    context.lineTo(box.left + 7, place_y(node));
  }
  context.strokeStyle = "#000";
  context.stroke();
  context.fillStyle = css("--ink");
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const share of [0, 0.25, 0.5, 0.75, 1])
    context.fillText(digits(value_at(x.state, share, x.low, x.high), 3), box.left + share * box.width,
      box.top + box.height + 16);
  context.fillText(x.state.label, box.left + box.width / 2, box.top + box.height + 36);
  context.textAlign = "right";
  for (const share of [0, 0.25, 0.5, 0.75, 1])
    context.fillText(digits(value_at(y.state, share, y.low, y.high), 3), box.left - 6,
      box.top + (1 - share) * box.height + 4);
  context.save();
  context.translate(14, box.top + box.height / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText(y.state.label, 0, 0);
  context.restore();
}

function draw_scale(context, box, low, high, levels) {
  const left = box.left + box.width + 14, width = 14;
  for (let i = 0; i < 100; ++i) {
    context.fillStyle = `rgb(${ramp_colour(i / 99)})`;
    context.fillRect(left, box.top + box.height * (1 - (i + 1) / 100), width, box.height / 100 + 0.5);
  }
  context.fillStyle = css("--ink");
  context.textAlign = "left";
  for (const level of levels)
    context.fillText(digits(level), left + width + 4,
      box.top + box.height * (1 - (level - low) / (high - low)) + 4);
}

// ---- values at the state of the sliders ----

function show_values() {
  const rows = [...view.shown].sort((a, b) => a - b).map((law) => {
    const tau = tau_of(law, view.at), band = data.laws[law].band;
    const number = (text) => element("td", {className: "num", textContent: text});
    const row = element("tr", {}, element("th", {textContent: data.laws[law].name}),
      number(digits(tau, 6)), number(band ? band.map((f) => digits(f * tau, 3)).join(" to ") : "–"),
      number(has_sigma ? digits(tau / view.at[sigma], 5) : "–"));
    row.dataset.law = data.laws[law].name;
    row.dataset.tau = String(tau);
    return row;
  });
  get("values").tBodies[0].replaceChildren(...rows);
  const beyond = data.states.filter((state) => !state.levels &&
    (view.at[state.name] < state.low || view.at[state.name] > state.high)).map((state) => state.label);
  get("outside").textContent = beyond.length ? `Beyond every test in ${beyond.join(", ")}.` : "";
}

// ---- all of it ----

// `all`: axes, laws or tests changed; otherwise only the state of the sliders.
function show(all = false) {
  const begin = performance.now();
  if (all) {
    make_curves();
    make_tests();
    make_stroke();
  } else {
    curves_plot.setData(curve_data());
  }
  draw_map();
  show_values();
  get("curves").setAttribute("aria-label", `${quantity_label()} along ${stateNamed[view.along].label}: ` +
    [...view.shown].map((law) => data.laws[law].name).join(", "));
  get("tests").setAttribute("aria-label", `mean residual of ${data.laws[view.law].name} per test`);
  get("curves-text").textContent = `Band: 90 % of new tests by ${data.laws[view.law].name}. ` +
    "Dots: rows of the tests at all values of their other states; ticks at the bottom: nodes of its table.";
  write_address();
  document.body.dataset.redraw_ms = String(Math.round(performance.now() - begin));
}

if (data.laws.length && data.states.length && stateNamed[view.along]) {
  read_address();
  make_controls();
  show(true);
  addEventListener("resize", () => show(true));
} else {
  get("controls").textContent = "There is no law with an input to show.";
}
