#include "lab/baselines/quaternion_forms.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

Form randomForm(Random *random, int degree) {
  Form form(monomialCount(degree));
  for (double &coefficient : form) coefficient = test::normal(random);
  return form;
}

const Eigen::Vector4d kPoint(0.7, -1.1, 0.4, 0.9);

// At kPoint.
double valueOf(const Form &form, int degree) {
  double value = 0;
  int place = 0;
  for (const Monomial &m : monomials(degree))
    value += form[place++] * std::pow(kPoint[0], degree - m.x - m.y - m.z) * std::pow(kPoint[1], m.x) *
             std::pow(kPoint[2], m.y) * std::pow(kPoint[3], m.z);
  return value;
}

TEST(QuaternionForms, EachMonomialIsInItsPlace) {
  const std::vector<Monomial> list = monomials(7);
  ASSERT_EQ(list.size(), static_cast<size_t>(monomialCount(7)));
  for (size_t i = 0; i < list.size(); ++i) EXPECT_EQ(list[i].place(), static_cast<int>(i));
}

TEST(QuaternionForms, ProductHasTheProductOfTheValues) {
  Random random(1);
  const Form a = randomForm(&random, 2), b = randomForm(&random, 4);
  EXPECT_NEAR(valueOf(product(a, 2, b, 4), 6), valueOf(a, 2) * valueOf(b, 4), 1e-12);
}

TEST(QuaternionForms, SquaredLengthIsDividedOut) {
  Random random(2);
  const Form a = randomForm(&random, 6);
  Form length2 = Form::Zero(monomialCount(2));
  for (const Monomial square : {Monomial{0, 0, 0}, Monomial{2, 0, 0}, Monomial{0, 2, 0}, Monomial{0, 0, 2}})
    length2[square.place()] = 1;
  EXPECT_LT((withoutSquaredLength(product(a, 6, length2, 2), 8) - a).norm(), 1e-12);
}

}  // namespace
}  // namespace sphc::host
