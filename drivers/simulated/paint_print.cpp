// paint_print.cpp - things with pictures and letters on them: pictures, books, magazines, boxes, the screen, the
// clock.
#include "drivers/simulated/paint.h"
#include "drivers/simulated/vec.h"

namespace sphc::simulated {
namespace {

void paper(Canvas &canvas, Rng &rng, const Ink &base, float contrast) {
  const auto seed = static_cast<uint32_t>(rng.next());
  canvas.fill([&](float x, float y) {
    return base * (1 + contrast * (fbm(x * 6, y * 6, 4, seed, 0.6f) + 0.6f * fbm(x * 150, y * 150, 2, seed + 1)));
  });
}

// Lines of words filling a rectangle.
void column(Canvas &canvas, Rng &rng, float x0, float y0, float x1, float y1, float height, const Ink &ink) {
  for (float y = y0; y + height < y1; y += 1.55f * height) {
    float x = x0;
    while (x < x1 - 3 * height) {
      const std::string word = randomWord(rng, 2 + rng.index(7));
      const float length = static_cast<float>(word.size()) * height * 6 / 7;
      if (x + length > x1) break;
      x += canvas.text(x, y, height, word, ink) + 0.6f * height;
    }
  }
}

void abstractPainting(Canvas &canvas, Rng &rng) {
  paper(canvas, rng, randomInk(rng, 0.1f, 0.5f, 0.5f, 0.9f), 0.25f);
  const float w = canvas.width(), h = canvas.height(), scale = std::min(w, h);
  for (int i = 0; i < 90; ++i) {
    const float size = scale * rng.uniform(0.03f, 0.3f) * (1 - static_cast<float>(i) / 110);
    const float x = rng.uniform(0, w), y = rng.uniform(0, h);
    const Ink ink = randomInk(rng, 0.2f, 0.9f, 0.15f, 0.95f);
    const int kind = rng.index(4);
    if (kind == 0) canvas.disc(x, y, 0.5f * size, ink, 0.85f);
    if (kind == 1) canvas.ring(x, y, 0.5f * size, 0.1f * size, ink);
    if (kind == 2) canvas.line(x, y, x + rng.uniform(-size, size), y + rng.uniform(-size, size), 0.08f * size, ink);
    if (kind == 3) {
      const float xy[6] = {x,
                           y,
                           x + rng.uniform(-size, size),
                           y + rng.uniform(-size, size),
                           x + rng.uniform(-size, size),
                           y + rng.uniform(-size, size)};
      canvas.triangle(xy, ink, 0.85f);
    }
  }
}

void landscape(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  const float w = canvas.width(), h = canvas.height();
  const float hue = rng.uniform(0.5f, 1.1f);
  canvas.fill([&](float x, float y) {
    const float up = 1 - y / h;
    Ink ink = mix(hsv(hue + 0.1f, 0.3f, 0.95f), hsv(hue, 0.55f, 0.65f), up) *
              (1 + 0.2f * fbm(x / w * 5, y / h * 14, 5, seed));
    for (int ridge = 0; ridge < 5; ++ridge) {
      const auto r = static_cast<float>(ridge);
      const float top = 0.72f - 0.13f * r + 0.2f * fbm(x / w * (2 + r), 3.7f * r, 5, seed + 11, 0.55f);
      if (up > top) continue;
      const float grain = fbm(x / w * 40, y / h * 40, 4, seed + static_cast<uint32_t>(ridge), 0.7f);
      ink = hsv(hue + 0.35f + 0.06f * r, 0.25f + 0.1f * r, 0.75f - 0.1f * r) * (1 + 0.4f * grain);
    }
    return ink;
  });
  canvas.disc(rng.uniform(0.15f, 0.85f) * w, 0.2f * h, 0.07f * std::min(w, h), {1, 0.93f, 0.7f, 0.7f});
  for (int i = 0; i < 60; ++i) {
    const float x = rng.uniform(0, w), y = h * rng.uniform(0.6f, 0.98f), s = h * rng.uniform(0.03f, 0.1f);
    const float tree[6] = {x, y - s, x - 0.35f * s, y, x + 0.35f * s, y};
    canvas.triangle(tree, hsv(rng.uniform(0.2f, 0.4f), 0.5f, rng.uniform(0.15f, 0.5f)));
  }
}

void poster(Canvas &canvas, Rng &rng) {
  paper(canvas, rng, mix(tasteful(rng), {0.95f, 0.92f, 0.85f, 0.7f}, rng.uniform(0.2f, 0.8f)), 0.08f);
  const float w = canvas.width(), h = canvas.height();
  const Ink dark = randomInk(rng, 0.4f, 0.9f, 0.1f, 0.3f);
  const std::string title = randomWord(rng, 5 + rng.index(3));
  const float letter = 0.88f * w / (static_cast<float>(title.size()) * 6.0f / 7.0f);
  canvas.text(0.06f * w, 0.05f * h, letter, title, dark);
  const float top = 0.09f * h + letter;
  for (int i = 0; i < 26; ++i) {
    const float r = 0.3f * w * (1 - static_cast<float>(i) / 26);
    const float x = 0.5f * w + rng.uniform(-0.12f, 0.12f) * w, y = top + 0.33f * w + rng.uniform(-0.08f, 0.08f) * w;
    const Ink ink = randomInk(rng, 0.3f, 0.9f, 0.2f, 0.95f);
    if (rng.chance(0.5f)) {
      canvas.disc(x, y, r, ink, 0.9f);
    } else {
      const float xy[6] = {x - r,        y + r * rng.uniform(0.2f, 1), x + r,
                           y + 0.6f * r, x + r * rng.uniform(-1, 1),   y - r};
      canvas.triangle(xy, ink, 0.9f);
    }
  }
  column(canvas, rng, 0.07f * w, top + 0.7f * w, 0.94f * w, h * 0.97f, std::max(0.011f, 0.03f * w), dark);
}

// A chart of regions with borders and names, like a map on a wall.
void chart(Canvas &canvas, Rng &rng) {
  constexpr int kSites = 48;
  const float w = canvas.width(), h = canvas.height();
  float sx[kSites], sy[kSites];
  Ink ink[kSites];
  for (int i = 0; i < kSites; ++i) {
    sx[i] = rng.uniform(0, w);
    sy[i] = rng.uniform(0, h);
    ink[i] = randomInk(rng, 0.15f, 0.55f, 0.5f, 0.95f);
  }
  const auto seed = static_cast<uint32_t>(rng.next());
  canvas.fill([&](float x, float y) {
    const float wx = x + 0.03f * fbm(x * 14, y * 14, 3, seed), wy = y + 0.03f * fbm(x * 14, y * 14, 3, seed + 5);
    float first = 1e9f, second = 1e9f;
    int best = 0;
    for (int i = 0; i < kSites; ++i) {
      const float d = (wx - sx[i]) * (wx - sx[i]) + (wy - sy[i]) * (wy - sy[i]);
      if (d < first) {
        second = first;
        first = d;
        best = i;
      } else if (d < second) {
        second = d;
      }
    }
    const float border = std::sqrt(second) - std::sqrt(first);
    return ink[best] * (0.45f + 0.55f * smooth(0.003f, 0.008f, border)) *
           (1 + 0.08f * fbm(x * 40, y * 40, 3, seed + 7));
  });
  for (int i = 0; i < kSites; ++i) {
    canvas.disc(sx[i], sy[i], 0.005f, {0.1f, 0.1f, 0.15f, 0.3f});
    canvas.text(sx[i] + 0.008f, sy[i], 0.014f, randomWord(rng, 3 + rng.index(5)), {0.1f, 0.1f, 0.15f, 0.3f});
  }
}

}  // namespace

void paintPicture(Canvas &canvas, Rng &rng) {
  switch (rng.index(4)) {
    case 0:
      abstractPainting(canvas, rng);
      break;
    case 1:
      landscape(canvas, rng);
      break;
    case 2:
      poster(canvas, rng);
      break;
    default:
      chart(canvas, rng);
  }
  canvas.speckle(rng, 1200, 0.002f, 0.015f, 0.25f);
}

void paintWindow(Canvas &canvas, Rng &rng) {
  landscape(canvas, rng);
  const float w = canvas.width(), h = canvas.height();
  for (int i = 0; i < 7; ++i) {
    const float x = rng.uniform(0, 0.85f) * w, width = rng.uniform(0.1f, 0.2f) * w,
                top = rng.uniform(0.3f, 0.6f) * h;
    const Ink wall = hsv(rng.uniform(0, 0.12f), rng.uniform(0.1f, 0.4f), rng.uniform(0.5f, 0.85f), 0.3f);
    canvas.rectangle(x, top, x + width, 0.9f * h, wall);
    for (float y = top + 0.03f; y < 0.86f * h; y += 0.055f) {
      for (float u = x + 0.015f; u < x + width - 0.03f; u += 0.04f) {
        canvas.rectangle(u, y, u + 0.02f, y + 0.03f, hsv(0.6f, 0.3f, rng.uniform(0.15f, 0.9f), 0.3f));
      }
    }
  }
}

void paintSpine(Canvas &canvas, Rng &rng) {
  const float w = canvas.width(), h = canvas.height();
  const Ink cover = tasteful(rng);
  paper(canvas, rng, cover, 0.12f);
  const bool is_dark = cover.r + cover.g + cover.b < 1.4f;
  const Ink ink = is_dark ? Ink{0.95f, 0.88f, 0.6f, 0.7f} : Ink{0.1f, 0.08f, 0.1f, 0.2f};
  const int bands = rng.index(4);
  for (int i = 0; i < bands; ++i) {
    const float y = h * (rng.chance(0.5f) ? rng.uniform(0.03f, 0.15f) : rng.uniform(0.82f, 0.96f));
    canvas.rectangle(0, y, w, y + rng.uniform(0.002f, 0.012f),
                     rng.chance(0.5f) ? ink : randomInk(rng, 0.3f, 0.8f, 0.3f, 0.9f));
  }
  const float letter = std::min(0.62f * w, 0.03f);
  const int room = std::max(2, static_cast<int>(0.62f * h / (letter * 6 / 7)));
  std::string title = randomWord(rng, std::min(room, 3 + rng.index(6)));
  while (static_cast<int>(title.size()) + 4 < room) title += " " + randomWord(rng, 2 + rng.index(5));
  title.resize(std::min(title.size(), static_cast<size_t>(room)));
  canvas.text(0.5f * (w + letter), 0.17f * h, letter, title, ink, true);
  canvas.disc(0.5f * w, 0.91f * h, 0.22f * w, ink, 0.8f);
  canvas.rectangle(0, 0, 0.0015f, h, cover * 0.4f, 0.7f);
  canvas.rectangle(w - 0.0015f, 0, w, h, cover * 0.4f, 0.7f);
}

// The back of a binder: marbled paper, a label and a hole for the finger.
void paintBinder(Canvas &canvas, Rng &rng) {
  const float w = canvas.width(), h = canvas.height();
  const auto seed = static_cast<uint32_t>(rng.next());
  canvas.fill([&](float x, float y) {
    return Ink{0.3f, 0.3f, 0.32f, 0.4f} * (1 + 0.35f * fbm(x * 160, y * 160, 3, seed));
  });
  const Ink ink{0.1f, 0.1f, 0.15f, 0.2f}, label{0.92f, 0.9f, 0.85f, 0.75f};
  canvas.rectangle(0.12f * w, 0.1f * h, 0.88f * w, 0.58f * h, label);
  canvas.rectangle(0.12f * w, 0.1f * h, 0.88f * w, 0.14f * h, tasteful(rng));
  for (int line = 0; line < 4; ++line)
    canvas.text(0.2f * w, (0.2f + 0.09f * static_cast<float>(line)) * h, 0.011f, randomWord(rng, 5), ink);
  canvas.ring(0.5f * w, 0.78f * h, 0.014f, 0.003f, {0.8f, 0.8f, 0.82f, 0.5f});
  canvas.disc(0.5f * w, 0.78f * h, 0.0125f, {0.05f, 0.05f, 0.05f, 0.1f});
}

void paintPaper(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  canvas.fill([&](float x, float y) {
    return Ink{0.86f, 0.82f, 0.72f, 0.7f} *
           (1 + 0.18f * noise(x * 20, y * 700, seed) + 0.1f * noise(x * 300, y * 300, seed));
  });
}

void paintMagazine(Canvas &canvas, Rng &rng) {
  poster(canvas, rng);
  canvas.speckle(rng, 800, 0.002f, 0.01f, 0.2f);
}

void paintScreen(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  const float w = canvas.width(), h = canvas.height();
  canvas.fill([&](float x, float y) {
    return Ink{0.13f, 0.14f, 0.16f, 0.04f} * (1 + 0.25f * (x / w - y / h) + 0.2f * fbm(x * 4, y * 4, 4, seed));
  });
  canvas.speckle(rng, 500, 0.003f, 0.02f, 0.5f);
  canvas.text(0.5f * w - 0.05f, h - 0.022f, 0.014f, randomWord(rng, 6), {0.6f, 0.6f, 0.62f, 0.3f});
}

void paintCardboard(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  const float w = canvas.width(), h = canvas.height();
  const Ink base = hsv(rng.uniform(0.07f, 0.11f), 0.38f, rng.uniform(0.58f, 0.75f), 0.6f);
  canvas.fill([&](float x, float y) {
    return base * (1 + 0.05f * std::sin(x * 900) + 0.14f * fbm(x * 8, y * 8, 5, seed, 0.65f));
  });
  canvas.rectangle(0.44f * w, 0, 0.56f * w, h, {0.72f, 0.62f, 0.42f, 0.6f}, 0.7f);
  const Ink ink{0.15f, 0.12f, 0.1f, 0.25f};
  canvas.text(0.06f * w, 0.1f * h, std::min(0.16f * h, 0.13f * w), randomWord(rng, 3 + rng.index(3)), ink);
  const float x = 0.55f * w, y = 0.55f * h;
  canvas.rectangle(x, y, 0.95f * w, 0.93f * h, {0.92f, 0.9f, 0.86f, 0.75f});
  column(canvas, rng, x + 0.01f, y + 0.01f, 0.94f * w, 0.78f * h, 0.014f, ink);
  for (float u = x + 0.01f; u < 0.92f * w; u += rng.uniform(0.004f, 0.012f)) {
    canvas.rectangle(u, 0.8f * h, u + rng.uniform(0.002f, 0.006f), 0.91f * h, ink);
  }
  canvas.speckle(rng, 1500, 0.003f, 0.03f, 0.3f);
}

void paintCeramic(Canvas &canvas, Rng &rng) {
  const float w = canvas.width(), h = canvas.height();
  paper(canvas, rng, tasteful(rng) * 1.2f, 0.12f);
  const float pitch = std::max(0.02f, 0.14f * h);
  for (float y = 0.5f * pitch; y < h; y += pitch) {
    const Ink ink = randomInk(rng, 0.3f, 0.8f, 0.15f, 0.9f);
    if (rng.chance(0.4f)) {
      canvas.rectangle(0, y, w, y + 0.3f * pitch, ink);
      continue;
    }
    for (float x = 0; x < w; x += pitch * rng.uniform(0.7f, 1.3f)) {
      canvas.disc(x, y, pitch * rng.uniform(0.12f, 0.4f),
                  rng.chance(0.6f) ? ink : randomInk(rng, 0.3f, 0.8f, 0.2f, 0.9f));
    }
  }
  canvas.speckle(rng, 3000, 0.002f, 0.012f, 0.3f);
}

void paintMetal(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  const Ink base = hsv(rng.uniform(), 0.08f, rng.uniform(0.3f, 0.7f), 0.35f);
  canvas.fill([&](float x, float y) { return base * (1 + 0.15f * fbm(x * 12, y * 160, 3, seed)); });
  canvas.speckle(rng, 1500, 0.002f, 0.012f, 0.4f);
}

void paintClock(Canvas &canvas, Rng &rng) {
  const float w = canvas.width(), c = 0.5f * w;
  paper(canvas, rng, {0.93f, 0.9f, 0.83f, 0.7f}, 0.06f);
  const Ink ink{0.1f, 0.08f, 0.1f, 0.2f};
  canvas.ring(c, c, 0.46f * w, 0.06f * w, randomInk(rng, 0.3f, 0.8f, 0.2f, 0.5f));
  for (int i = 0; i < 60; ++i) {
    const float a = static_cast<float>(i) * kFloatPi / 30, inner = i % 5 == 0 ? 0.36f : 0.4f;
    canvas.line(c + inner * w * std::sin(a), c - inner * w * std::cos(a), c + 0.42f * w * std::sin(a),
                c - 0.42f * w * std::cos(a), i % 5 == 0 ? 0.02f * w : 0.006f * w, ink);
    if (i % 5 != 0) continue;
    const std::string hour = std::to_string(i == 0 ? 12 : i / 5);
    canvas.text(c + 0.29f * w * std::sin(a) - 0.035f * w * static_cast<float>(hour.size()),
                c - 0.29f * w * std::cos(a) - 0.04f * w, 0.085f * w, hour, ink);
  }
  for (const float length : {0.2f, 0.32f}) {
    const float a = rng.uniform(0, 2 * kFloatPi);
    canvas.line(c, c, c + length * w * std::sin(a), c - length * w * std::cos(a), 0.025f * w, ink);
  }
}

}  // namespace sphc::simulated
