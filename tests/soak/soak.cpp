// Plays hours of a headset in minutes and checks what holds after every frame.  Prints totals as name,value.
//
//   soak [--seed N] [--frames N]         that many frames
//   soak --minutes N                     as many as N minutes of this machine's time allow
//   soak --twice                         twice, and the answers must have the same bytes
//   soak --break guard|heap|bytes|poses  breaks a promise, to show that it is seen
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/memory/sealed_heap.h"
#include "tests/soak/day.h"

namespace {

using sphc::soak::Day;
using sphc::soak::Totals;
using sphc::soak::World;

struct Options {
  uint64_t seed = 1, frames = 3000, minutes = 0;
  bool twice = false;
  std::string broken;
};

[[noreturn]] void refuse(const std::string &word) {
  std::fprintf(stderr, "soak: \"%s\" is not known; the head of soak.cpp has the options\n", word.c_str());
  std::exit(2);
}

uint64_t numberOf(const std::string &word) {
  char *end = nullptr;
  const uint64_t number = std::strtoull(word.c_str(), &end, 10);
  if (word.empty() || *end) refuse(word);
  return number;
}

std::string promiseOf(const std::string &word) {
  if (word != "guard" && word != "heap" && word != "bytes" && word != "poses") refuse(word);
  return word;
}

Options optionsFrom(int argc, char **argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--twice") {
      options.twice = true;
      continue;
    }
    if (name != "--seed" && name != "--frames" && name != "--minutes" && name != "--break") refuse(name);
    const std::string value = i + 1 < argc ? argv[++i] : "";
    if (name == "--seed") options.seed = numberOf(value);
    if (name == "--frames") options.frames = numberOf(value);
    if (name == "--minutes") options.minutes = numberOf(value);
    if (name == "--break") options.broken = promiseOf(value);
  }
  return options;
}

Totals played(const World &world, const Options &options) {
  const auto begin = std::chrono::steady_clock::now();
  Day day(&world, options.seed);
  if (options.broken == "guard") day.breakGuard();
  if (options.broken == "poses") day.breakPoses();
  do {
    day.play(options.frames);
  } while (std::chrono::steady_clock::now() - begin < std::chrono::minutes(options.minutes));
  return day.totals();
}

void print(const Totals &totals, double seconds) {
  std::printf("frames,%llu\n", static_cast<unsigned long long>(totals.frames));
  std::printf("hours_at_30_frames_a_second,%.2f\n", static_cast<double>(totals.frames) / 30 / 3600);
  std::printf("seconds_taken,%.0f\n", seconds);
  const struct {
    const char *name;
    uint64_t value;
  } counts[] = {{"localized", totals.localized},   {"tracked", totals.tracked},
                {"elsewhere", totals.elsewhere},   {"wrong_room", totals.wrong_room},
                {"wrong_pose", totals.wrong_pose}, {"broken", totals.broken},
                {"priors", totals.priors},         {"deadlines", totals.deadlines},
                {"halves", totals.halves},         {"refused_calls", totals.refused_calls},
                {"rooms", totals.rooms},           {"unplugs", totals.unplugs},
                {"swaps", totals.swaps},           {"resets", totals.resets},
                {"restarts", totals.restarts}};
  for (const auto &count : counts)
    std::printf("%s,%llu\n", count.name, static_cast<unsigned long long>(count.value));
}

}  // namespace

int main(int argc, char **argv) {
  const Options options = optionsFrom(argc, argv);
  if (options.broken == "heap") {
    sphc::test::sealHeap();
    void *volatile held = std::malloc(8);  // volatile: else the compiler leaves both calls out
    std::free(held);
    return 0;
  }
  const World world;
  const auto begin = std::chrono::steady_clock::now();
  const Totals totals = played(world, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  if (options.twice) {
    Options again = options;
    again.seed += options.broken == "bytes";
    if (played(world, again).digest != totals.digest) {
      std::fprintf(stderr, "soak: broken promise: the same seed gives the same bytes\n");
      return 1;
    }
  }
  if (!world.guardsIntact()) {
    std::fprintf(stderr, "soak: broken promise: maps keep inside their memory\n");
    return 1;
  }
  std::printf("what,value\n");
  print(totals, took.count());
  if (const char *fault = sphc::soak::faultOf(totals)) {
    std::fprintf(stderr, "soak: broken promise: %s\n", fault);
    return 1;
  }
  return 0;
}
