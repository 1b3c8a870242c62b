#include "drivers/simulated/scene.h"

#include <algorithm>
#include <utility>

#include "drivers/simulated/light.h"
#include "drivers/simulated/parallel.h"

namespace sphc::simulated {

Scene makeScene(uint64_t seed, uint32_t threads) {
  Builder builder(seed);
  Scene scene;
  scene.plan = layOut(builder);
  scene.shapes = std::move(builder.shapes);
  scene.pool = std::move(builder.pool);
  scene.pool.allocate();
  const Bvh bvh(scene.shapes);
  // Largest first, so that no thread is left with a wall at the end.
  std::vector<Job> jobs = std::move(builder.jobs);
  const auto area = [&](const Job &job) {
    const Texture &texture = scene.pool.texture(job.texture);
    return static_cast<uint64_t>(texture.width) * texture.height;
  };
  std::stable_sort(jobs.begin(), jobs.end(), [&](const Job &a, const Job &b) { return area(a) > area(b); });
  parallelFor(static_cast<uint32_t>(jobs.size()), threads, [&](uint32_t i) {
    const Job &job = jobs[i];
    const Shape &shape = scene.shapes[job.shape];
    const Texture &texture = scene.pool.texture(job.texture);
    float width_m = 0, height_m = 0;
    faceSize(shape, job.face, &width_m, &height_m);
    Canvas canvas(scene.pool.texels(job.texture), texture.width, texture.height, width_m, height_m);
    paint(canvas, job.material, job.seed);
    if (!isBright(job.material)) shade(bvh, scene.plan, shape, job.face, texture, scene.pool.texels(job.texture));
    scene.pool.buildPyramid(job.texture);
  });
  return scene;
}

float clearance(const Scene &scene, const Vec3f &point) {
  float nearest = kFar;
  for (const Shape &shape : scene.shapes) nearest = std::min(nearest, distanceTo(shape, point));
  return nearest;
}

}  // namespace sphc::simulated
