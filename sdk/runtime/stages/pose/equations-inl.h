// Normal equations of the refinement; see score-inl.h for how it is compiled.
#if defined(SPHC_POSE_EQUATIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHC_POSE_EQUATIONS_INL_H
#undef SPHC_POSE_EQUATIONS_INL_H
#else
#define SPHC_POSE_EQUATIONS_INL_H
#endif

#include "runtime/stages/pose/minimal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {
namespace {  // every file that includes this has its own

// Index of (row, column >= row) in the upper triangle.
constexpr uint32_t entryOf(uint32_t row, uint32_t column) {
  return row * kPoseUnknowns - row * (row + 1) / 2 + column;
}

// Lane sums of everything in NormalSums.
struct LaneSums {
  alignas(64) float matrix[kNormalEntries][kPoseLanes];
  alignas(64) float gradient[kPoseUnknowns][kPoseLanes];
  alignas(64) float cost[kPoseLanes];
};
HWY_INLINE void addTo(float *lanes, V x) {
  const PoseTag d;
  hn::Store(hn::Add(hn::Load(d, lanes), x), d, lanes);
}

// Geman-McClure: loss = s / (1 + s / scale2), weight = its derivative.  Beyond the gate: no pull.
struct Loss {
  V loss, weight;
};
HWY_INLINE Loss gemanMcClure(V squared, hn::Mask<PoseTag> in_front, const NormalTask &task) {
  const V fall = hn::Div(set(1.0f), hn::Add(set(1.0f), hn::Mul(squared, set(task.inverse_scale2))));
  const auto near = hn::And(in_front, hn::Lt(squared, set(task.gate2)));
  return {hn::IfThenElse(near, hn::Mul(squared, fall), set(1.0f / task.inverse_scale2)),
          hn::IfThenElseZero(near, hn::Mul(fall, fall))};
}

// N = W (I - n n^T) W in the metric: what a shift of the ray's foot costs.
struct Symmetric {
  V xx, xy, xz, yy, yz, zz;
};
HWY_INLINE V3 times(const Symmetric &m, const V3 &a) {
  return {dot({m.xx, m.xy, m.xz}, a), dot({m.xy, m.yy, m.yz}, a), dot({m.xz, m.yz, m.zz}, a)};
}

// A row with its depth corrected.  The correction lengthens the point, and its error with it: else a shorter scale
// would always fit better.
struct RowV {
  V3 point, view, direction;
  V weight, stretch;
};
HWY_INLINE RowV rowAt(const PoseRows &rows, const NormalTask &task, size_t at) {
  const PoseTag d;
  RowV row = {load3(rows, kPointX, at), load3(rows, kViewX, at), load3(rows, kDirectionX, at),
              hn::Load(d, rows.field[kWeight] + at), hn::Load(d, rows.field[kStretch] + at)};
  if (task.with_bias) {
    const V bias = hn::Add(set(task.correction.offset_m),
                           hn::Mul(set(task.correction.slope), hn::Sub(row.point.z, set(task.correction.mid_m))));
    const V longer = hn::Add(set(1.0f), hn::Div(bias, row.point.z));
    row.point = longer * row.point;
    row.weight = hn::Div(row.weight, square(longer));
  }
  return row;
}
HWY_INLINE ResidualV residualOf(const PoseV &pose, const RowV &row) {
  return residualOf(pose, row.point, row.view, row.direction, row.weight, row.stretch);
}

template <bool kWithBias>
HWY_INLINE void addLifted(const PoseRows &rows, const PoseV &pose, const NormalTask &task, size_t at, size_t lane,
                          LaneSums *sums) {
  const PoseTag d;
  const RowV row = rowAt(rows, task, at);
  const V3 view = row.view;
  const V stretch = row.stretch;
  const ResidualV r = residualOf(pose, row);
  const Loss loss = gemanMcClure(r.squared, hn::Gt(r.along, hn::Zero(d)), task);
  addTo(sums->cost + lane, loss.loss);
  const V w = hn::Mul(loss.weight, row.weight);
  // y = W^2 q and g = W^2 n, both over weight
  const V3 y = r.offset + hn::Mul(stretch, r.view_offset) * view, g = r.ray + hn::Mul(stretch, r.view_ray) * view;
  const V3 vs = stretch * view, gs = hn::Div(set(1.0f), r.metric_ray2) * g;
  const Symmetric n = {hn::Mul(w, hn::Add(set(1.0f), hn::Sub(hn::Mul(vs.x, view.x), hn::Mul(gs.x, g.x)))),
                       hn::Mul(w, hn::Sub(hn::Mul(vs.x, view.y), hn::Mul(gs.x, g.y))),
                       hn::Mul(w, hn::Sub(hn::Mul(vs.x, view.z), hn::Mul(gs.x, g.z))),
                       hn::Mul(w, hn::Add(set(1.0f), hn::Sub(hn::Mul(vs.y, view.y), hn::Mul(gs.y, g.y)))),
                       hn::Mul(w, hn::Sub(hn::Mul(vs.y, view.z), hn::Mul(gs.y, g.z))),
                       hn::Mul(w, hn::Add(set(1.0f), hn::Sub(hn::Mul(vs.z, view.z), hn::Mul(gs.z, g.z))))};
  const V3 pull = w * y;
  // The foot of the ray moves by omega x foot + rho, the point by the bias along its ray.
  const V3 foot = row.point - r.offset;
  const V zero = hn::Zero(d);
  const V3 turn[3] = {
      {zero, hn::Neg(foot.z), foot.y}, {foot.z, zero, hn::Neg(foot.x)}, {hn::Neg(foot.y), foot.x, zero}};
  for (uint32_t i = 0; i < 3; ++i) {
    const V3 across = times(n, turn[i]);
    for (uint32_t j = i; j < 3; ++j) addTo(sums->matrix[entryOf(i, j)] + lane, dot(across, turn[j]));
    addTo(sums->matrix[entryOf(i, 3)] + lane, across.x);
    addTo(sums->matrix[entryOf(i, 4)] + lane, across.y);
    addTo(sums->matrix[entryOf(i, 5)] + lane, across.z);
    addTo(sums->gradient[i] + lane, hn::Neg(dot(turn[i], pull)));
  }
  addTo(sums->matrix[entryOf(3, 3)] + lane, n.xx);
  addTo(sums->matrix[entryOf(3, 4)] + lane, n.xy);
  addTo(sums->matrix[entryOf(3, 5)] + lane, n.xz);
  addTo(sums->matrix[entryOf(4, 4)] + lane, n.yy);
  addTo(sums->matrix[entryOf(4, 5)] + lane, n.yz);
  addTo(sums->matrix[entryOf(5, 5)] + lane, n.zz);
  addTo(sums->gradient[3] + lane, hn::Neg(pull.x));
  addTo(sums->gradient[4] + lane, hn::Neg(pull.y));
  addTo(sums->gradient[5] + lane, hn::Neg(pull.z));
  if (!kWithBias) return;
  // The correction as a shift of the foot; taken at the foot, whose error does not go with the residual's.
  const V foot_z = hn::IfThenElse(hn::Eq(foot.z, zero), set(1.0f), foot.z);  // zero in padding alone
  const V3 longer = hn::Div(set(-1.0f), foot_z) * foot;
  const V beyond = hn::Sub(foot.z, set(task.correction.mid_m));
  const V3 across = times(n, longer);
  const V self = dot(across, longer), slope_self = hn::Mul(beyond, self), bias_pull = dot(longer, pull);
  for (uint32_t i = 0; i < 3; ++i) {
    const V turned = dot(across, turn[i]), shifted = i == 0 ? across.x : i == 1 ? across.y : across.z;
    addTo(sums->matrix[entryOf(i, 6)] + lane, turned);
    addTo(sums->matrix[entryOf(i, 7)] + lane, hn::Mul(beyond, turned));
    addTo(sums->matrix[entryOf(3 + i, 6)] + lane, shifted);
    addTo(sums->matrix[entryOf(3 + i, 7)] + lane, hn::Mul(beyond, shifted));
  }
  addTo(sums->matrix[entryOf(6, 6)] + lane, self);
  addTo(sums->matrix[entryOf(6, 7)] + lane, slope_self);
  addTo(sums->matrix[entryOf(7, 7)] + lane, hn::Mul(beyond, slope_self));
  addTo(sums->gradient[6] + lane, hn::Neg(bias_pull));
  addTo(sums->gradient[7] + lane, hn::Neg(hn::Mul(beyond, bias_pull)));
}

// Sine of the angle between viewing ray and epipolar plane (of t - centre and R d), over its sigma.
struct PlaneV {
  V3 view, ray, normal;
  V inverse_length;  // of the normal
  V sine, weight, squared;
  hn::Mask<PoseTag> in_front;  // the rays meet in front of the camera and in the direction's positive half
};
HWY_INLINE PlaneV planeOf(const PoseRows &rows, const PoseV &pose, size_t at) {
  const PoseTag d;
  PlaneV p;
  p.view = load3(rows, kViewX, at);
  p.ray = rotate(pose, load3(rows, kDirectionX, at));
  const V3 t = fromCentre(rows, pose.t, at);
  p.normal = cross(t, p.ray);
  p.inverse_length = hn::Div(set(1.0f), hn::Sqrt(hn::Max(dot(p.normal, p.normal), set(1e-12f))));
  p.sine = hn::Mul(dot(p.view, p.normal), p.inverse_length);
  const V3 point = fromCentre(rows, load3(rows, kPointX, at), at), parallax = cross(p.view, p.ray);
  p.weight = hn::Mul(hn::Load(d, rows.field[kWeight] + at), dot(point, point));
  p.squared = hn::Mul(p.weight, square(p.sine));
  p.in_front =
      hn::And(hn::Gt(dot(p.normal, parallax), hn::Zero(d)), hn::Gt(dot(cross(t, p.view), parallax), hn::Zero(d)));
  return p;
}

HWY_INLINE void addPlane(const PoseRows &rows, const PoseV &pose, const NormalTask &task, size_t at, size_t lane,
                         LaneSums *sums) {
  const PlaneV p = planeOf(rows, pose, at);
  const Loss loss = gemanMcClure(p.squared, p.in_front, task);
  addTo(sums->cost + lane, loss.loss);
  const V w = hn::Mul(loss.weight, p.weight);
  const V3 lever = p.inverse_length * (p.view - hn::Mul(p.sine, p.inverse_length) * p.normal);
  const V3 shift = cross(p.ray, lever);
  V3 turn = cross(p.normal, lever);
  if (rows.hasCentres()) turn = turn + cross(load3(rows, kCentreX, at), shift);  // t turns, the centre does not
  const V jacobian[6] = {turn.x, turn.y, turn.z, shift.x, shift.y, shift.z};
  for (uint32_t i = 0; i < 6; ++i) {
    const V weighted = hn::Mul(w, jacobian[i]);
    for (uint32_t j = i; j < 6; ++j) addTo(sums->matrix[entryOf(i, j)] + lane, hn::Mul(weighted, jacobian[j]));
    addTo(sums->gradient[i] + lane, hn::Mul(weighted, p.sine));
  }
}

void residuals(const PoseRows &rows, const NormalTask &task, float *squared) {
  const PoseTag d;
  const PoseV pose = broadcast(task.pose);
  for (size_t at = 0; at < rows.padded; at += hn::Lanes(d)) {
    const ResidualV r = residualOf(pose, rowAt(rows, task, at));
    hn::StoreU(hn::IfThenElse(hn::Gt(r.along, hn::Zero(d)), r.squared, set(kNeverNear)), d, squared + at);
  }
}

void planeResiduals(const PoseRows &rows, const NormalTask &task, float *squared) {
  const PoseTag d;
  const PoseV pose = broadcast(task.pose);
  for (size_t at = 0; at < rows.padded; at += hn::Lanes(d)) {
    const PlaneV p = planeOf(rows, pose, at);
    hn::StoreU(hn::IfThenElse(p.in_front, p.squared, set(kNeverNear)), d, squared + at);
  }
}

template <typename AddRow>
HWY_INLINE void sumRows(const PoseRows &rows, const AddRow &add, NormalSums *sums) {
  const PoseTag d;
  LaneSums lanes = {};
  for (size_t block = 0; block < rows.padded; block += kPoseLanes)
    for (size_t lane = 0; lane < kPoseLanes; lane += hn::Lanes(d)) add(block + lane, lane, &lanes);
  for (uint32_t i = 0; i < kNormalEntries; ++i) sums->matrix[i] = sumOf(lanes.matrix[i]);
  for (uint32_t i = 0; i < kPoseUnknowns; ++i) sums->gradient[i] = sumOf(lanes.gradient[i]);
  sums->cost = sumOf(lanes.cost);
}

void liftedEquations(const PoseRows &rows, const NormalTask &task, NormalSums *sums) {
  const PoseV pose = broadcast(task.pose);
  if (task.with_bias)
    sumRows(
        rows, [&](size_t at, size_t lane, LaneSums *s) { addLifted<true>(rows, pose, task, at, lane, s); }, sums);
  else
    sumRows(
        rows, [&](size_t at, size_t lane, LaneSums *s) { addLifted<false>(rows, pose, task, at, lane, s); }, sums);
}

void planeEquations(const PoseRows &rows, const NormalTask &task, NormalSums *sums) {
  const PoseV pose = broadcast(task.pose);
  sumRows(
      rows, [&](size_t at, size_t lane, LaneSums *s) { addPlane(rows, pose, task, at, lane, s); }, sums);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();
#endif
