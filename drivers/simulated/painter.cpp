#include "drivers/simulated/painter.h"

namespace sphc::simulated {

Painter::Painter(const Scene &scene, const std::vector<Job> &jobs)
    : shapes_(scene.shapes),
      outdoors_(scene.outdoors),
      fixed_(scene.shapes.begin(), scene.shapes.begin() + scene.fixed_count),
      bvh_(fixed_),
      plan_(scene.plan),
      lighting_(scene.lighting),
      jobs_(scene.pool.size()) {
  for (const Job &job : jobs) jobs_[job.texture] = job;
}

void Painter::paint(uint32_t index, const Texture &texture, Texel *texels) const {
  const Job &job = jobs_[index];
  const Shape &shape = job.shape < shapes_.size() ? shapes_[job.shape] : outdoors_[0];
  float width_m = 0, height_m = 0;
  faceSize(shape, job.face, &width_m, &height_m);
  Canvas canvas(texels, texture.width, texture.height, width_m, height_m);
  simulated::paint(canvas, job.material, job.style, job.seed);
  if (isBright(job.material))
    glow(lighting_, shape, job.material, texture, texels);
  else
    shade(bvh_, plan_, lighting_, shape, job.face, texture, texels);
}

}  // namespace sphc::simulated
