// One call of VFRIC: its 42 arguments as arrays of the solver's precision, owned here.
#pragma once

#include <cstddef>
#include <vector>

namespace frictab::calls {

// Real is float or double, as the vaba_param.inc the routine was compiled with says. All arrays are
// sized by `resize` to the dimensions of the argument list and filled with zero.
template <class Real> struct VfricCall {
  int contacts = 0;        // nContact
  int secondary_nodes = 0; // nSecNod
  int directions = 3;      // nDir; nFricDir = nDir - 1
  int states = 3;          // nStateVar
  int predefined = 0;      // nPred
  int definitions = 0;     // numDefTfv: contacts, or 1 for an analytical rigid main surface
  bool rigid = false;      // analytical rigid main surface: no facet, no main node
  bool temperatures = false;
  Real time_increment = 0;
  int step = 1, increment = 1;
  std::vector<Real> properties;

  std::vector<int> node;                           // jConSecid, from 1
  std::vector<int> node_numbers;                   // jSecUid: secondary_nodes
  std::vector<Real> tangential;                    // out: (nDir-1, contacts)
  std::vector<Real> state;                         // in, out: (states, secondary_nodes)
  std::vector<Real> slip;                          // (nDir, contacts)
  std::vector<Real> stick, normal;                 // contacts
  std::vector<Real> previous;                      // (nDir, contacts)
  std::vector<Real> area;                          // secondary_nodes
  std::vector<Real> temperature, temperature_main; // contacts, definitions
  std::vector<Real> field, field_main; // (contacts, predefined), (definitions, predefined)

  // node is 1..contacts, all of number 7; areas 1; stick unlimited.
  void resize(int contact_count, int node_count);
  // Runs the routine at this address.
  void run(void* function);
};

extern template struct VfricCall<float>;
extern template struct VfricCall<double>;

} // namespace frictab::calls
