// paint_cloth.cpp - carpet, upholstery, curtains, lampshade, leaves.
#include "drivers/simulated/paint.h"
#include "drivers/simulated/vec.h"

namespace sphc::simulated {
namespace {

// A motif of the carpet: nested shapes of the palette, drawn by chance.
void motif(Canvas &canvas, Rng &rng, float x, float y, float radius, const Ink palette[5]) {
  float r = radius;
  for (int layer = 0; layer < 3; ++layer) {
    const Ink &ink = palette[rng.index(5)];
    const int kind = rng.index(4);
    const auto distance = [&](float px, float py) {
      const float ex = std::fabs(px - x), ey = std::fabs(py - y);
      if (kind == 0) return ex + ey - r;
      if (kind == 1) return std::max(ex, ey) - 0.75f * r;
      if (kind == 2) return std::min(std::max(ex, 3 * ey), std::max(3 * ex, ey)) - r;
      return std::sqrt(ex * ex + ey * ey) - 0.9f * r;
    };
    canvas.figure(x - r, y - r, x + r, y + r, distance, ink, 0.92f);
    r *= rng.uniform(0.45f, 0.75f);
  }
}

void carpetBorder(Canvas &canvas, Rng &rng, float inset, float width, const Ink palette[5]) {
  const float w = canvas.width(), h = canvas.height();
  const Ink &ink = palette[rng.index(5)];
  canvas.rectangle(inset, inset, w - inset, inset + width, ink);
  canvas.rectangle(inset, h - inset - width, w - inset, h - inset, ink);
  canvas.rectangle(inset, inset, inset + width, h - inset, ink);
  canvas.rectangle(w - inset - width, inset, w - inset, h - inset, ink);
  const float middle = inset + 0.5f * width, pitch = 1.15f * width;
  for (float x = middle; x < w - inset; x += pitch) {
    motif(canvas, rng, x, middle, 0.42f * width, palette);
    motif(canvas, rng, x, h - middle, 0.42f * width, palette);
  }
  for (float y = middle + pitch; y < h - middle; y += pitch) {
    motif(canvas, rng, middle, y, 0.42f * width, palette);
    motif(canvas, rng, w - middle, y, 0.42f * width, palette);
  }
}

void threads(Canvas &canvas, Rng &rng, const Ink &base, float strength) {
  const auto seed = static_cast<uint32_t>(rng.next());
  canvas.fill([&](float x, float y) {
    const float weave = noise(x * 260, y * 130, seed) + noise(x * 120, y * 260, seed + 1);
    return base * (1 + strength * weave + 0.12f * fbm(x * 7, y * 7, 4, seed + 2, 0.6f));
  });
}

}  // namespace

void paintCarpet(Canvas &canvas, Rng &rng) {
  Ink palette[5];
  for (Ink &ink : palette) ink = tasteful(rng);
  threads(canvas, rng, palette[1], 0.12f);
  const float w = canvas.width(), h = canvas.height();
  const float field = 0.32f;
  const float pitch = rng.uniform(0.1f, 0.15f);
  for (float y = field; y < h - field; y += pitch) {
    for (float x = field; x < w - field; x += pitch) {
      motif(canvas, rng, x + rng.uniform(-0.02f, 0.02f), y + rng.uniform(-0.02f, 0.02f),
            pitch * rng.uniform(0.25f, 0.55f), palette);
    }
  }
  for (int i = 5; i > 0; --i) motif(canvas, rng, 0.5f * w, 0.5f * h, 0.09f * static_cast<float>(i), palette);
  carpetBorder(canvas, rng, 0.02f, 0.06f, palette);
  carpetBorder(canvas, rng, 0.09f, 0.15f, palette);
  carpetBorder(canvas, rng, 0.25f, 0.06f, palette);
  canvas.speckle(rng, 5000, 0.003f, 0.02f, 0.3f);
}

void paintFabric(Canvas &canvas, Rng &style, Rng &rng) {
  const Ink base = tasteful(style) * 1.15f;
  threads(canvas, rng, base, 0.1f);
  const int kind = style.index(3);
  const float pitch = style.uniform(0.05f, 0.1f), band = style.uniform(0.006f, 0.02f);
  Ink palette[5];
  for (Ink &ink : palette) ink = mix(base, tasteful(style), style.uniform(0.3f, 0.9f));
  const float w = canvas.width(), h = canvas.height();
  if (kind == 0) {
    for (float x = 0; x < w; x += pitch * rng.uniform(0.5f, 1.4f)) {
      canvas.rectangle(x, 0, x + band, h, palette[rng.index(5)], 0.5f);
    }
    for (float y = 0; y < h; y += pitch * rng.uniform(0.5f, 1.4f)) {
      canvas.rectangle(0, y, w, y + band, palette[rng.index(5)], 0.5f);
    }
  } else {
    const float jitter = kind == 1 ? 0.1f : 0.35f;
    for (float y = 0.5f * pitch; y < h; y += pitch) {
      for (float x = 0.5f * pitch; x < w; x += pitch) {
        motif(canvas, rng, x + pitch * rng.uniform(-jitter, jitter), y + pitch * rng.uniform(-jitter, jitter),
              pitch * rng.uniform(0.2f, 0.5f), palette);
      }
    }
  }
  canvas.speckle(rng, 2500, 0.003f, 0.02f, 0.35f);
}

void paintCurtain(Canvas &canvas, Rng &style, Rng &rng) {
  paintFabric(canvas, style, rng);
  const float w = canvas.width(), h = canvas.height();
  for (float x = 0; x < w; x += rng.uniform(0.03f, 0.07f)) {
    const float slant = rng.uniform(-0.02f, 0.02f);
    canvas.line(x, 0, x + slant, h, rng.uniform(0.008f, 0.022f), {0.08f, 0.07f, 0.1f, 0.5f}, 0.3f);
    canvas.line(x + 0.02f, 0, x + 0.02f + slant, h, 0.008f, {0.95f, 0.93f, 0.9f, 0.6f}, 0.2f);
  }
}

void paintLampshade(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  canvas.fill([&](float x, float y) {
    const float glow = 1 - 0.5f * std::fabs(2 * y / canvas.height() - 1);
    return Ink{0.98f, 0.88f, 0.65f, 0.7f} * (glow * (0.9f + 0.1f * fbm(x * 60, y * 60, 3, seed)));
  });
  for (float x = 0; x < canvas.width(); x += 0.05f) {
    canvas.line(x, 0, x + rng.uniform(-0.03f, 0.03f), canvas.height(), 0.004f, {0.5f, 0.38f, 0.22f, 0.5f}, 0.7f);
  }
  canvas.speckle(rng, 1500, 0.004f, 0.02f, 0.2f);
}

void paintLeaves(Canvas &canvas, Rng &rng) {
  canvas.fill([&](float, float) { return Ink{0.1f, 0.17f, 0.07f, 0.5f}; });
  const float w = canvas.width(), h = canvas.height();
  const int count = static_cast<int>(w * h * 1600);
  for (int i = 0; i < count; ++i) {
    const float x = rng.uniform(0, w), y = rng.uniform(0, h), a = rng.uniform(0, 2 * kFloatPi);
    const float length = rng.uniform(0.02f, 0.06f), c = std::cos(a), s = std::sin(a);
    const Ink leaf = hsv(rng.uniform(0.2f, 0.38f), rng.uniform(0.45f, 0.8f), rng.uniform(0.2f, 0.7f), 0.7f);
    const auto distance = [&](float px, float py) {
      const float u = ((px - x) * c + (py - y) * s) / length, v = ((py - y) * c - (px - x) * s) / length;
      return length * (std::fabs(v) - 0.3f * (1 - u * u));
    };
    canvas.figure(
        x - length, y - length, x + length, y + length, [&](float px, float py) { return distance(px, py); }, leaf,
        0.95f);
    canvas.line(x - 0.8f * length * c, y - 0.8f * length * s, x + 0.8f * length * c, y + 0.8f * length * s, 0.002f,
                leaf * 1.4f, 0.7f);
  }
}

}  // namespace sphc::simulated
