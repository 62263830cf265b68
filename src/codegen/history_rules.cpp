// Writes the rules of the table in histories.h.
#include "codegen/history_rules.h"

#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace frictab::codegen {

namespace {

using C = data::Continuation;

const char* const is_h = "@{x} = @{h}@{convert}";

// Rules of one text each; history_rule() has those that depend on what they follow as well.
const std::map<C::Rule, HistoryRule> plain_rules = {
    {C::per_slip,
     {.now = is_h,
      .next = "@{h1} = @{h}\n"
              "if (ds .gt. 0.0D0) @{h1} = @{h} + p*ds",
      .meaning = "pressure times slip, summed"}},
    {C::per_time,
     {.now = is_h, .next = "@{h1} = @{h} + dt", .meaning = "time under pressure", .unit = "s"}},
    {C::dwell,
     {.now = is_h,
      .next = "@{h1} = @{h}\n"
              "if (ftnan(pmax)) then\n"
              "  @{h1} = pmax\n"
              "else if (p .ge. 0.5D0*pmax) then\n"
              "  @{h1} = @{h} + dt\n"
              "end if",
      .meaning = "time at no less than half of the peak pressure",
      .unit = "s"}},
    {C::since_peak,
     {.now = is_h,
      .next = "@{h1} = @{h}\n"
              "if (ds .gt. 0.0D0) @{h1} = @{h} + ds\n"
              "if (ftnan(pmax)) then\n"
              "  @{h1} = pmax\n"
              "else if (p .ge. @{at_peak}*pmax) then\n"
              "  @{h1} = 0.0D0\n"
              "end if",
      .meaning = "slip since the pressure was last within 5 % of its peak",
      .grows = false}},
    {C::ratio,
     {.now = "@{x} = ftrat(p, ftmost(@{h}, p))",
      .next = "@{h1} = ftmost(@{h}, p)",
      .slope = "if (@{h} .gt. max(p, 0.0D0)) dp = dp + @{dy}/(@{h}@{from_stress})",
      .meaning = "peak pressure that the load is compared with",
      .unit = "MPa",
      .grows = false}},
    {C::direction,
     {.now = "@{x} = ftrsng(ftturn(@{h}, p))",
      .next = "@{h1} = ftturn(@{h}, p)",
      .meaning = "highest pressure while it rises, minus the lowest while it falls",
      .unit = "MPa",
      .grows = false}},
    {C::rise,
     {.now = "@{x} = ftrise(@{h}, t)",
      .next = "@{h1} = ftfrst(@{h}, t)",
      .slope = "if (@{h} .gt. 0.0D0) dt = dt + @{dy}",
      .meaning = "temperature at the start of contact; 0: none yet",
      .unit = "K",
      .grows = false}},
    {C::recent,
     {.now = "@{x} = ftlate(@{h}, v, @{increments})@{convert}",
      .next = "@{h1} = ftlate(@{h}, v, @{increments})",
      .meaning = "smoothed sliding speed; 0: none yet",
      .grows = false}},
    {C::growth,
     {.now = "@{x} = ftgrow(@{h}, a)",
      .next = "@{h1} = @{h}\n"
              "if (@{h} .le. 0.0D0) @{h1} = a",
      .meaning = "area at the first contact; 0: none yet",
      .unit = "mm^2",
      .grows = false}}};

// Sums q dt, which mean and lag divide by the time.
HistoryRule sum_over_time(const C& how) {
  HistoryRule out;
  if (how.rule == C::mean) {
    out.now = "@{x} = ftmean(@{h}, @{time}, @{q})@{convert}";
    out.slope = "if (@{time} .le. 0.0D0) d@{argument} = d@{argument} + @{dy}";
  } else {
    out.now = "@{x} = @{q} - ftmean(@{h}, @{time}, @{q})";
    out.slope = "if (@{time} .gt. 0.0D0) dt = dt + @{dy}";
  }
  out.next = "@{h1} = @{h}\n"
             "if (dt .gt. 0.0D0) @{h1} = @{h} + @{q}*dt";
  out.meaning = fmt::format("{} times time under pressure", followed(how.of).name);
  out.unit = how.of == C::speed ? "mm" : followed(how.of).unit + std::string(" s");
  return out;
}

HistoryRule peak(C::Of of) {
  if (of == C::temperature)
    return {.now = "@{x} = ftmost(@{h}, t + 273.15D0)\n"
                   "@{x} = @{x} - 273.15D0",
            .next = "@{h1} = ftmost(@{h}, t + 273.15D0)",
            .slope = "if (t + 273.15D0 .gt. @{h}) dt = dt + @{dy}",
            .meaning = "peak temperature; 0: none yet",
            .unit = "K",
            .grows = false};
  return {.now = "@{x} = ftmost(@{h}, @{q})@{convert}",
          .next = "@{h1} = ftmost(@{h}, @{q})",
          .slope = "if (@{q} .gt. @{h}) d@{q} = d@{q} + @{dy}",
          .meaning = fmt::format("peak {}", followed(of).name),
          .grows = false};
}

HistoryRule last_increment(C::Of of) {
  if (of == C::flash)
    return {.now = is_h,
            .next = "@{h1} = 0.0D0\n"
                    "if (v .gt. 0.0D0) @{h1} = tau*sqrt(v@{from_speed})",
            .meaning = "tau sqrt(v), v in mm/s, in the last increment under pressure",
            .grows = false};
  return {.now = is_h,
          .next = "@{h1} = 0.0D0\n"
                  "if (v .gt. 0.0D0) @{h1} = tau*v",
          .meaning = "friction power per area in the last increment under pressure",
          .grows = false};
}

// Uses the state before the increment, as all histories do; the slip of the increment ages it
// afterwards.
HistoryRule slip_state(C::Rule rule) {
  return {.now = "@{x} = ftthta(@{h}, v@{from_length}, @{distance})@{convert}",
          .next = rule == C::aging ? "@{h1} = ftaged(@{h}, v@{from_length}, dt, @{distance})"
                                   : "@{h1} = ftslpd(@{h}, v@{from_length}, dt, @{distance})",
          .slope = "if (@{h} .le. 0.0D0 .and. v@{from_speed} .gt. @{slowest}) then\n"
                   "  dv = dv - @{dy}*@{distance}/(v@{from_speed})**2\n"
                   "end if",
          .meaning = "state variable of rate-and-state friction; 0: none yet",
          .unit = "s",
          .grows = false};
}

} // namespace

HistoryRule history_rule(const data::Continuation& how) {
  switch (how.rule) {
  case C::mean:
  case C::lag:
    return sum_over_time(how);
  case C::peak:
    return peak(how.of);
  case C::last:
    return last_increment(how.of);
  case C::aging:
  case C::slipping:
    return slip_state(how.rule);
  default:
    break;
  }
  const auto found = plain_rules.find(how.rule);
  if (found == plain_rules.end()) throw std::logic_error("no routine continues this history");
  return found->second;
}

const Followed& followed(data::Continuation::Of of) {
  static const Followed pressure = {"sigma_n_MPa", "MPa", "pressure", "p"};
  static const Followed speed = {"v_rel_mm_s", "mm/s", "sliding speed", "v"};
  static const Followed temperature = {"T_contact_C", "degC", "temperature", "t"};
  static const Followed area = {"", "mm^2", "area", "a"};
  if (of == C::pressure) return pressure;
  if (of == C::area) return area;
  return of == C::speed ? speed : temperature;
}

} // namespace frictab::codegen
