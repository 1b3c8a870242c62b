#include "lab/baselines/quaternion_forms.h"

namespace sphc::host {
namespace {

constexpr int kMaxDegree = 8;

// Up to kMaxDegree, each once.
const std::vector<Monomial> &table() {
  static const std::vector<Monomial> all = monomials(kMaxDegree);
  return all;
}

}  // namespace

std::vector<Monomial> monomials(int degree) {
  std::vector<Monomial> list;
  for (int total = 0; total <= degree; ++total)
    for (int yz = 0; yz <= total; ++yz)
      for (int z = 0; z <= yz; ++z) list.push_back({total - yz, yz - z, z});
  return list;
}

Form product(const Form &a, int degree_a, const Form &b, int degree_b) {
  const std::vector<Monomial> &monomial = table();
  Form result = Form::Zero(monomialCount(degree_a + degree_b));
  for (int i = 0; i < monomialCount(degree_a); ++i)
    for (int j = 0; j < monomialCount(degree_b); ++j)
      result[(monomial[static_cast<size_t>(i)] * monomial[static_cast<size_t>(j)]).place()] += a[i] * b[j];
  return result;
}

Form withoutSquaredLength(const Form &a, int degree) {
  const std::vector<Monomial> &monomial = table();
  Form quotient(monomialCount(degree - 2));
  for (int i = 0; i < quotient.size(); ++i) {  // by rising degree in x, y and z
    const Monomial &m = monomial[static_cast<size_t>(i)];
    quotient[i] = a[i];
    if (m.x >= 2) quotient[i] -= quotient[Monomial{m.x - 2, m.y, m.z}.place()];
    if (m.y >= 2) quotient[i] -= quotient[Monomial{m.x, m.y - 2, m.z}.place()];
    if (m.z >= 2) quotient[i] -= quotient[Monomial{m.x, m.y, m.z - 2}.place()];
  }
  return quotient;
}

}  // namespace sphc::host
