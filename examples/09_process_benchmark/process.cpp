#include "process.h"

#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "heat.h"

namespace {

constexpr int most_halvings = 6;

// One process while it runs.
class Run {
public:
  explicit Run(const Setup& setup)
      : setup_(setup), platens_(setup.process != "rod"), parts_(platens_ ? 2 : 1),
        law_(friction_law(setup.law)),
        die_(make_die(setup)), contact_{&setup_.material,
                                        law_.get(),
                                        &die_,
                                        setup.penalty,
                                        setup.sticking_share * setup.speed,
                                        setup.soft_pressure,
                                        0},
        billet_(shape(setup), sides(setup), contact_, setup.temperature) {
    if (setup.heat.on) heat_ = std::make_unique<Heat>(billet_, setup.heat, setup.temperature);
    result_.first_volume = parts_ * billet_.volume();
    result_.steps.push_back(record(0));
    result_.steps[0].force = 0;
  }

  // Equal steps, but the first in parts: there the metal starts to flow.
  Result go() {
    const double whole = platens_ ? setup_.reduction * setup_.height : setup_.stroke;
    const double step = whole / static_cast<double>(setup_.steps);
    for (const double end : {1. / 64, 1. / 32, 1. / 16, 1. / 8, 1. / 4, 1. / 2})
      advance_to(end * step);
    for (std::size_t i = 1; i <= setup_.steps; ++i)
      advance_to(whole * static_cast<double>(i) / static_cast<double>(setup_.steps));
    return std::move(result_);
  }

private:
  static Die make_die(const Setup& s) {
    if (s.process != "rod") return Die::platen(s.height / 2);
    // The bar is pressed into the container, up to where its corner begins.
    return Die::nozzle(s.height + s.corner, s.outer_diameter / 2 - s.press_fit, s.exit_diameter / 2,
                       s.half_angle * M_PI / 180, s.corner);
  }
  static Shape shape(const Setup& s) {
    const double inner_radius = s.process == "ring" ? s.inner_diameter / 2 : 0;
    const double height = s.process == "rod" ? s.height : s.height / 2;
    return {inner_radius, s.outer_diameter / 2, height, s.columns, s.rows};
  }
  // The free sides of ring and cylinder fold onto the platens where friction is high.
  static std::set<Side> sides(const Setup& s) {
    if (s.process == "ring") return {top, inner, outer};
    if (s.process == "upsetting") return {top, outer};
    return {outer};
  }

  void advance_to(double stroke) {
    double part = stroke - stroke_;
    for (int halvings = 0; stroke_ < stroke - 1e-12;) {
      part = std::min(part, stroke - stroke_);
      int iterations = 0;
      try {
        iterations = equilibrium(stroke_ + part);
      } catch (const std::exception& fault) {
        if (++halvings > most_halvings)
          throw std::runtime_error("no equilibrium found at a stroke of " +
                                   std::to_string(stroke_) + " mm: " + fault.what());
        part /= 2;
        continue;
      }
      keep(stroke_ + part, iterations);
    }
  }

  int equilibrium(double stroke) {
    contact_.time_step = (stroke - stroke_) / setup_.speed;
    if (!platens_) return billet_.step(stroke, 0);
    die_.move_to((setup_.height - stroke) / 2);
    return billet_.step(0, stroke / setup_.height);
  }

  void keep(double stroke, int iterations) {
    result_.contact.push_back(billet_.contact());
    const double error = billet_.friction_error();
    die_force_ = billet_.force();
    billet_.keep();
    StepRecord now = record(stroke);
    now.iterations = iterations;
    now.friction_error = error;
    now.work =
        result_.last().work + 0.5e3 * (now.force + result_.last().force) * (stroke - stroke_);
    if (heat_) heat_->step(contact_.time_step);
    result_.steps.push_back(now);
    stroke_ = stroke;
  }

  StepRecord record(double stroke) {
    StepRecord now;
    now.stroke = stroke;
    now.reduction = stroke / setup_.height;
    const Shape s = shape(setup_);
    now.inner_mid = billet_.node(s.inner_radius, 0)[0];
    now.inner_top = billet_.node(s.inner_radius, s.height)[0];
    if (s.inner_radius > 0)
      now.inner_mean = billet_.integral("(X(1)+u(1))*(1+Grad_u(2,2))/(2*pi*X(1))", inner) /
                       billet_.integral("(1+Grad_u(2,2))/(2*pi*X(1))", inner);
    now.outer_mid = billet_.node(s.outer_radius, 0)[0];
    now.outer_top = billet_.node(s.outer_radius, s.height)[0];
    now.volume = parts_ * billet_.volume();
    const Energies e = billet_.energies();
    now.energies = {parts_ * e.plastic, parts_ * e.friction, parts_ * e.elastic};
    if (!result_.contact.empty()) add_contact(now, result_.contact.back());
    return now;
  }

  void add_contact(StepRecord& now, const std::vector<ContactRecord>& points) {
    double area = 0;
    for (const ContactRecord& point : points) {
      area += point.area;
      now.mean_temperature += point.area * point.state.temperature;
      now.mean_pressure += point.area * point.state.pressure;
      now.outside += point.outside ? point.area : 0;
      result_.sliding_points += point.touches;
    }
    if (area > 0) {
      now.mean_temperature /= area;
      now.mean_pressure /= area;
      now.outside /= area;
    }
    // The plates press the half from above, the punch pushes the rod from below.
    const double die = std::abs(die_force_), support = std::abs(billet_.bottom_force());
    now.force = support / 1e3;
    now.imbalance = std::abs(die - support) / std::max(support, 1.0);
  }

  Setup setup_;
  bool platens_;
  double parts_; // the whole consists of so many of what is modelled
  std::unique_ptr<FrictionLaw> law_;
  Die die_;
  ContactSetting contact_;
  Billet billet_;
  std::unique_ptr<Heat> heat_;
  Result result_;
  double stroke_ = 0, die_force_ = 0;
};

} // namespace

Setup default_setup(const std::string& process) {
  Setup setup;
  setup.process = process;
  if (process == "upsetting") {
    setup.outer_diameter = 12;
    setup.height = 12;
    setup.columns = 8;
    setup.rows = 8;
  } else if (process == "rod") {
    setup.outer_diameter = 10;
    setup.height = 10;
    setup.columns = 5;
    setup.rows = 24;
    setup.steps = 100;
  }
  return setup;
}

Result run_process(const Setup& setup) {
  gmm::set_traces_level(0);
  return Run(setup).go();
}

void write_result(const Result& result, const std::string& name, std::size_t every) {
  std::ofstream force(name + "_force.csv"), contact(name + "_contact.csv");
  force.precision(10);
  contact.precision(10);
  force << "stroke_mm,reduction,force_kN,inner_mid_mm,inner_top_mm,inner_mean_mm,outer_mid_mm,"
           "T_contact_C,pressure_MPa,outside,volume_mm3,work_J,plastic_J,friction_J,elastic_J\n";
  for (const StepRecord& s : result.steps)
    force << s.stroke << ',' << s.reduction << ',' << s.force << ',' << s.inner_mid << ','
          << s.inner_top << ',' << s.inner_mean << ',' << s.outer_mid << ',' << s.mean_temperature
          << ',' << s.mean_pressure << ',' << s.outside << ',' << s.volume << ',' << s.work / 1e3
          << ',' << s.energies.plastic / 1e3 << ',' << s.energies.friction / 1e3 << ','
          << s.energies.elastic / 1e3 << '\n';
  contact << "stroke_mm,r_mm,z_mm,area_mm2,sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,s_mm,"
             "sigma_f_MPa,tau_MPa,outside\n";
  for (std::size_t i = 0; i < result.contact.size(); i += every)
    for (const ContactRecord& c : result.contact[i])
      if (c.touches)
        contact << result.steps[i + 1].stroke << ',' << c.r << ',' << c.z << ',' << c.area << ','
                << c.state.pressure << ',' << c.state.expansion << ',' << c.state.speed << ','
                << c.state.temperature << ',' << c.state.slid << ',' << c.state.flow_stress << ','
                << c.tau << ',' << c.outside << '\n';
  if (!force.flush() || !contact.flush())
    throw std::runtime_error("cannot write " + name + "_force.csv and _contact.csv");
}
