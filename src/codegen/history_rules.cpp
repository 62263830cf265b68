// Returns the rules of the table in histories.h, one function per rule.
#include "codegen/history_rules.h"

#include <stdexcept>

#include <fmt/format.h>

namespace frictab::codegen {

namespace {

using C = data::Continuation;

const char* const is_h = "@{x} = @{h}@{convert}";

HistoryRule energy() {
  return {.now = is_h,
          .next = "@{h1} = @{h}\n"
                  "if (ds .gt. 0.0D0) @{h1} = @{h} + p*ds",
          .meaning = "pressure times slip, summed"};
}

HistoryRule time_under_pressure() {
  return {.now = is_h, .next = "@{h1} = @{h} + dt", .meaning = "time under pressure", .unit = "s"};
}

HistoryRule dwell() {
  return {.now = is_h,
          .next = "@{h1} = @{h}\n"
                  "if (ftnan(pmax)) then\n"
                  "  @{h1} = pmax\n"
                  "else if (p .ge. 0.5D0*pmax) then\n"
                  "  @{h1} = @{h} + dt\n"
                  "end if",
          .meaning = "time at no less than half of the peak pressure",
          .unit = "s"};
}

HistoryRule slip_since_peak() {
  return {.now = is_h,
          .next = "@{h1} = @{h}\n"
                  "if (ds .gt. 0.0D0) @{h1} = @{h} + ds\n"
                  "if (ftnan(pmax)) then\n"
                  "  @{h1} = pmax\n"
                  "else if (p .ge. @{at_peak}*pmax) then\n"
                  "  @{h1} = 0.0D0\n"
                  "end if",
          .meaning = "slip since the pressure was last within 5 % of its peak",
          .grows = false};
}

// Sums q dt, which mean and lag divide by the time.
HistoryRule sum_over_time(C::Of of) {
  HistoryRule sum;
  sum.next = "@{h1} = @{h}\n"
             "if (dt .gt. 0.0D0) @{h1} = @{h} + @{q}*dt";
  sum.meaning = fmt::format("{} times time under pressure", followed(of).name);
  sum.unit = of == C::speed ? "mm" : followed(of).unit + std::string(" s");
  return sum;
}

HistoryRule mean(C::Of of) {
  HistoryRule out = sum_over_time(of);
  out.now = "@{x} = ftmean(@{h}, @{time}, @{q})@{convert}";
  out.slope = "if (@{time} .le. 0.0D0) d@{argument} = d@{argument} + @{dy}";
  return out;
}

HistoryRule lag(C::Of of) {
  HistoryRule out = sum_over_time(of);
  out.now = "@{x} = @{q} - ftmean(@{h}, @{time}, @{q})";
  out.slope = "if (@{time} .gt. 0.0D0) dt = dt + @{dy}";
  return out;
}

HistoryRule peak_temperature() {
  return {.now = "@{x} = ftmost(@{h}, t + 273.15D0)\n"
                 "@{x} = @{x} - 273.15D0",
          .next = "@{h1} = ftmost(@{h}, t + 273.15D0)",
          .slope = "if (t + 273.15D0 .gt. @{h}) dt = dt + @{dy}",
          .meaning = "peak temperature; 0: none yet",
          .unit = "K",
          .grows = false};
}

HistoryRule peak(C::Of of) {
  if (of == C::temperature) return peak_temperature();
  return {.now = "@{x} = ftmost(@{h}, @{q})@{convert}",
          .next = "@{h1} = ftmost(@{h}, @{q})",
          .slope = "if (@{q} .gt. @{h}) d@{q} = d@{q} + @{dy}",
          .meaning = fmt::format("peak {}", followed(of).name),
          .grows = false};
}

HistoryRule load_over_peak() {
  return {.now = "@{x} = ftrat(p, ftmost(@{h}, p))",
          .next = "@{h1} = ftmost(@{h}, p)",
          .slope = "if (@{h} .gt. max(p, 0.0D0)) dp = dp + @{dy}/(@{h}@{from_stress})",
          .meaning = "peak pressure that the load is compared with",
          .unit = "MPa",
          .grows = false};
}

HistoryRule load_direction() {
  return {.now = "@{x} = ftrsng(ftturn(@{h}, p))",
          .next = "@{h1} = ftturn(@{h}, p)",
          .meaning = "highest pressure while it rises, minus the lowest while it falls",
          .unit = "MPa",
          .grows = false};
}

HistoryRule rise() {
  return {.now = "@{x} = ftrise(@{h}, t)",
          .next = "@{h1} = ftfrst(@{h}, t)",
          .slope = "if (@{h} .gt. 0.0D0) dt = dt + @{dy}",
          .meaning = "temperature at the start of contact; 0: none yet",
          .unit = "K",
          .grows = false};
}

HistoryRule friction_power() {
  return {.now = is_h,
          .next = "@{h1} = 0.0D0\n"
                  "if (v .gt. 0.0D0) @{h1} = tau*v",
          .meaning = "friction power per area in the last increment under pressure",
          .grows = false};
}

HistoryRule flash_heating() {
  return {.now = is_h,
          .next = "@{h1} = 0.0D0\n"
                  "if (v .gt. 0.0D0) @{h1} = tau*sqrt(v@{from_speed})",
          .meaning = "tau sqrt(v), v in mm/s, in the last increment under pressure",
          .grows = false};
}

HistoryRule recent_speed() {
  return {.now = "@{x} = ftlate(@{h}, v, @{increments})@{convert}",
          .next = "@{h1} = ftlate(@{h}, v, @{increments})",
          .meaning = "smoothed sliding speed; 0: none yet",
          .grows = false};
}

// Uses the state before the increment, as all histories do; the slip of the increment ages it
// afterwards.
HistoryRule slip_state(C::Rule rule) {
  HistoryRule out;
  out.now = "@{x} = ftthta(@{h}, v@{from_length}, @{distance})@{convert}";
  out.next = rule == C::aging ? "@{h1} = ftaged(@{h}, v@{from_length}, dt, @{distance})"
                              : "@{h1} = ftslpd(@{h}, v@{from_length}, dt, @{distance})";
  out.slope = "if (@{h} .le. 0.0D0 .and. v@{from_speed} .gt. @{slowest}) then\n"
              "  dv = dv - @{dy}*@{distance}/(v@{from_speed})**2\n"
              "end if";
  out.meaning = "state variable of rate-and-state friction; 0: none yet";
  out.unit = "s";
  out.grows = false;
  return out;
}

HistoryRule area_growth() {
  return {.now = "@{x} = ftgrow(@{h}, a)",
          .next = "@{h1} = @{h}\n"
                  "if (@{h} .le. 0.0D0) @{h1} = a",
          .meaning = "area at the first contact; 0: none yet",
          .unit = "mm^2",
          .grows = false};
}

} // namespace

HistoryRule history_rule(const data::Continuation& how) {
  switch (how.rule) {
  case C::per_slip:
    return energy();
  case C::per_time:
    return time_under_pressure();
  case C::dwell:
    return dwell();
  case C::mean:
    return mean(how.of);
  case C::peak:
    return peak(how.of);
  case C::last:
    return how.of == C::flash ? flash_heating() : friction_power();
  case C::ratio:
    return load_over_peak();
  case C::since_peak:
    return slip_since_peak();
  case C::direction:
    return load_direction();
  case C::rise:
    return rise();
  case C::lag:
    return lag(how.of);
  case C::recent:
    return recent_speed();
  case C::growth:
    return area_growth();
  case C::aging:
  case C::slipping:
    return slip_state(how.rule);
  case C::none:
    break;
  }
  throw std::logic_error("no routine continues this history");
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
