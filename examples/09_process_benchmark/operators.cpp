#include "operators.h"

#include <getfem/getfem_generic_assembly.h>

namespace {

using bgeot::base_tensor;
using bgeot::multi_index;
using bgeot::size_type;

// What both have in common: a vector as the result, no second derivatives.
struct VectorOperator : getfem::ga_nonlinear_operator {
  VectorOperator(const ContactSetting& setting, size_type arguments, size_type size)
      : set(setting), count(arguments), length(size) {}
  bool result_size(const arg_list& args, multi_index& sizes) const override {
    sizes.resize(1);
    sizes[0] = length;
    return args.size() == count;
  }
  void second_derivative(const arg_list&, size_type, size_type, base_tensor&) const override {
    GMM_ASSERT1(false, "second derivatives are not needed by Newton's method");
  }
  const ContactSetting& set;
  size_type count, length;
};

// F with the numbers `first` .. `first + 4` of the Dual as its components.
template <class S> Gradient<S> gradient_of(const base_tensor& H) {
  return {1.0 + H[0], S(H[1]), S(H[2]), 1.0 + H[3], 1.0 + H[4]};
}
template <int N> Gradient<Dual<N>> variable_gradient_of(const base_tensor& H) {
  using D = Dual<N>;
  return {D::variable(1 + H[0], 0), D::variable(H[1], 1), D::variable(H[2], 2),
          D::variable(1 + H[3], 3), D::variable(1 + H[4], 4)};
}

class NominalStress : public VectorOperator {
public:
  explicit NominalStress(const ContactSetting& setting) : VectorOperator(setting, 3, 5) {}

  void value(const arg_list& args, base_tensor& result) const override {
    const Gradient<double> P = nominal_stress(*set.material, unpack_history(*args[2], 0),
                                              gradient_of<double>(*args[0]), (*args[1])[0]);
    const double values[] = {P.rr, P.rz, P.zr, P.zz, P.tt};
    std::copy(values, values + 5, result.begin());
  }
  void derivative(const arg_list& args, size_type argument, base_tensor& result) const override {
    using D = Dual<6>;
    const Gradient<D> P =
        nominal_stress(*set.material, unpack_history(*args[2], 0),
                       variable_gradient_of<6>(*args[0]), D::variable((*args[1])[0], 5));
    const D* values[] = {&P.rr, &P.rz, &P.zr, &P.zz, &P.tt};
    const unsigned first = argument == 1 ? 0 : 5, number = argument == 1 ? 5 : 1;
    for (unsigned j = 0; j < number; ++j)
      for (unsigned i = 0; i < 5; ++i)
        result[i + 5 * j] = values[i]->d[first + j];
  }
};

class DieTraction : public VectorOperator {
public:
  explicit DieTraction(const ContactSetting& setting) : VectorOperator(setting, 6, 2) {}

  void value(const arg_list& args, base_tensor& result) const override {
    const Traction<double> t = traction(
        set, point<double>(args, gradient_of<double>(*args[0]), (*args[1])[0], (*args[1])[1]));
    result[0] = t.r;
    result[1] = t.z;
  }
  void derivative(const arg_list& args, size_type argument, base_tensor& result) const override {
    using D = Dual<7>;
    const Traction<D> t =
        traction(set, point<D>(args, variable_gradient_of<7>(*args[0]),
                               D::variable((*args[1])[0], 5), D::variable((*args[1])[1], 6)));
    const unsigned first = argument == 1 ? 0 : 5, number = argument == 1 ? 5 : 2;
    for (unsigned j = 0; j < number; ++j) {
      result[2 * j] = t.r.d[first + j];
      result[2 * j + 1] = t.z.d[first + j];
    }
  }

private:
  template <class S>
  SurfacePoint<S> point(const arg_list& args, const Gradient<S>& F, const S& u_r,
                        const S& u_z) const {
    const base_tensor &X = *args[2], &before = *args[3], &normal = *args[4], &memory = *args[5];
    return {X[0] + u_r, X[1] + u_z, u_r - before[0],      u_z - before[1],          F,
            normal[0],  normal[1],  memory[history_size], unpack_history(memory, 0)};
  }
};

} // namespace

void register_operators(const ContactSetting& setting) {
  auto& table = dal::singleton<getfem::ga_predef_operator_tab>::instance();
  table.add_method("Nominal_stress", std::make_shared<NominalStress>(setting));
  table.add_method("Die_traction", std::make_shared<DieTraction>(setting));
}
