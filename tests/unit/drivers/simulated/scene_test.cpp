// What each option of `with` does to the room, seen without paint: solids, faces and rays.
#include "drivers/simulated/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "drivers/simulated/headset.h"
#include "drivers/simulated/raster.h"
#include "handle.h"

namespace sphc::simulated::test {
namespace {

constexpr double kLap_s = 16;
constexpr uint64_t kSeed = 7;

// A room without paint, and what a few hundred rays of the colour camera meet.
class Bare {
 public:
  explicit Bare(uint32_t with, uint64_t arrangement_seed = 0, uint64_t seed = kSeed)
      : scene(buildScene(configOf(with, arrangement_seed, seed), jobs)),
        walk(scene, kSeed, kLap_s, (with & SPHC_SIMULATED_FEET) != 0),
        camera_(camerasOf(SPHC_SIMULATED_CAMERAS_HEADSET).rig.color_camera),
        rays_(camera_) {}

  struct Ray {
    Vec3f origin, direction;  // z of a hit is its parameter
    Hit hit;
  };
  std::vector<Ray> look(double time_s) const {
    std::vector<Shape> shapes = scene.shapes;
    scene.actors.move(walk, time_s, shapes);
    const Pose pose = walk.at(time_s);
    const Raster raster(scene, shapes, camera_, rays_, {pose, pose, pose, pose});
    std::vector<Ray> seen;
    for (uint32_t tile_row = 0; tile_row < raster.tileRows(); ++tile_row) {
      raster.forTileRow(tile_row, [&](uint32_t column, uint32_t row, const Raster::List &list) {
        if (column % kTile != 8 || row % kTile != 8) return;
        const Ray2 ray = rays_.center(column, row);
        const Hits hits = raster.cast(list, {{ray, ray, ray, ray}});
        const Vec3f direction =
            toFloat(pose.rotation * Vec3d{static_cast<double>(ray.x), static_cast<double>(ray.y), 1});
        seen.push_back({toFloat(pose.center), direction, hits.lane[0]});
      });
    }
    return seen;
  }
  bool isActor(const Hit &hit) const { return hit.portal == 0 && hit.shape >= scene.fixed_count; }
  double actorShare(double time_s) const {
    const std::vector<Ray> rays = look(time_s);
    const auto count = std::count_if(rays.begin(), rays.end(), [&](const Ray &ray) { return isActor(ray.hit); });
    return static_cast<double>(count) / static_cast<double>(rays.size());
  }
  size_t facesOf(Material material) const {
    return static_cast<size_t>(
        std::count_if(jobs.begin(), jobs.end(), [&](const Job &job) { return job.material == material; }));
  }
  // How often the commonest painting of a material is there.
  size_t mostEqual(Material material) const {
    std::map<uint64_t, size_t> seeds;
    size_t most = 0;
    for (const Job &job : jobs) {
      if (job.material == material) most = std::max(most, ++seeds[job.seed]);
    }
    return most;
  }

  std::vector<Job> jobs;
  Scene scene;
  Walk walk;

 private:
  static sphc_simulated_config configOf(uint32_t with, uint64_t arrangement_seed, uint64_t seed) {
    sphc_simulated_config config = defaults();
    config.seed = seed;
    config.with = with;
    config.arrangement_seed = arrangement_seed;
    return config;
  }

  sphc_camera camera_;
  RayTable rays_;
};

TEST(SimulatedScene, WithNothingNothingMovesAndNothingIsSeenThrough) {
  const Bare bare(0);
  EXPECT_EQ(bare.scene.fixed_count, bare.scene.shapes.size());
  EXPECT_TRUE(bare.scene.portals.empty());
  EXPECT_TRUE(bare.scene.outdoors.empty());
}

// Also where a lap takes an odd number of steps.
TEST(SimulatedScene, TheWalkClosesWhateverALapTakes) {
  const Bare room(0);
  for (const double lap_s : {5.0, 12.0, 15.0, 16.0}) {
    const Walk walk(room.scene, kSeed, lap_s, false);
    const Pose before = walk.at(2 * lap_s - 1e-6), after = walk.at(2 * lap_s);
    EXPECT_LT(norm(after.center - before.center), 1e-5) << lap_s;
    for (int i = 0; i < 3; ++i)
      EXPECT_LT(norm(after.rotation.row[i] - before.rotation.row[i]), 1e-5) << lap_s << " s a lap";
  }
}

TEST(SimulatedScene, HandsComeIntoViewCloseBy) {
  const Bare bare(SPHC_SIMULATED_HANDS);
  double least = 1, most = 0;
  for (double time_s = 0; time_s < kLap_s; time_s += 0.5) {
    const double share = bare.actorShare(time_s);
    least = std::min(least, share);
    most = std::max(most, share);
    for (const Bare::Ray &ray : bare.look(time_s)) {
      EXPECT_TRUE(!bare.isActor(ray.hit) || ray.hit.z < 0.6f);
    }
  }
  EXPECT_GT(most, 0.05);
  EXPECT_LT(least, 0.02);
}

TEST(SimulatedScene, FeetAreSeenAtTheSamePlacesOfBothLaps) {
  const Bare bare(SPHC_SIMULATED_FEET);
  for (const double lap : {0.0, kLap_s}) {
    for (int glance = 0; glance < 3; ++glance) {
      EXPECT_GT(bare.actorShare(lap + (glance + 0.5) * kLap_s / 3), 0.02) << glance;
      EXPECT_EQ(bare.actorShare(lap + glance * kLap_s / 3), 0) << glance;
    }
  }
}

TEST(SimulatedScene, PeopleWalkElsewhereInTheSecondLapAndNeverMeetTheCamera) {
  const Bare bare(SPHC_SIMULATED_PEOPLE);
  int seen = 0, changed = 0;
  for (double time_s = 0; time_s < kLap_s; time_s += 1) {
    const double first = bare.actorShare(time_s), second = bare.actorShare(time_s + kLap_s);
    seen += first > 0.01 ? 1 : 0;
    changed += std::fabs(first - second) > 0.01 ? 1 : 0;
    std::vector<Shape> shapes = bare.scene.shapes;
    bare.scene.actors.move(bare.walk, time_s, shapes);
    for (size_t i = bare.scene.fixed_count; i < shapes.size(); ++i) {
      EXPECT_GT(distanceTo(shapes[i], toFloat(bare.walk.at(time_s).center)), 0.3f) << time_s;
    }
  }
  EXPECT_GT(seen, 4);
  EXPECT_GT(changed, 2);
}

TEST(SimulatedScene, AFloorThatRepeatsIsAllThereIs) {
  const std::pair<uint32_t, Material> floors[] = {{SPHC_SIMULATED_CARPET, Material::kFittedCarpet},
                                                  {SPHC_SIMULATED_PARQUET, Material::kParquet},
                                                  {SPHC_SIMULATED_TILES, Material::kTiles}};
  EXPECT_EQ(Bare(0).facesOf(Material::kCarpet), 1u);
  for (const auto &[with, material] : floors) {
    const Bare bare(with);
    EXPECT_EQ(bare.facesOf(material), 1u);
    EXPECT_EQ(bare.facesOf(Material::kFloor), 0u);
    EXPECT_EQ(bare.facesOf(Material::kCarpet), 0u) << "no rug hides it";
  }
}

TEST(SimulatedScene, BareWallsHaveNothingOnThem) {
  EXPECT_GT(Bare(0).facesOf(Material::kPicture), 3u);
  const Bare bare(SPHC_SIMULATED_BARE);
  EXPECT_EQ(bare.facesOf(Material::kBare), 5u);
  EXPECT_EQ(bare.facesOf(Material::kPicture) + bare.facesOf(Material::kClock), 0u);
}

TEST(SimulatedScene, OnePaperIsOnAllWallsAlsoWhereTheyAreBare) {
  for (const uint32_t bare : {0u, uint32_t{SPHC_SIMULATED_BARE}}) {
    const Bare papered(SPHC_SIMULATED_WALLPAPER | bare);
    EXPECT_EQ(papered.facesOf(Material::kRepeatingWallpaper), 4u);
    EXPECT_EQ(papered.facesOf(Material::kPicture) == 0, bare != 0);
    std::set<uint64_t> papers;
    for (const Job &job : papered.jobs) {
      if (job.material == Material::kRepeatingWallpaper) papers.insert(job.style);
    }
    EXPECT_EQ(papers.size(), 1u);
  }
}

TEST(SimulatedScene, BindersAreEqualAndTheSameInAnotherRoom) {
  const Bare here(SPHC_SIMULATED_BINDERS), elsewhere(SPHC_SIMULATED_BINDERS, 0, kSeed + 1);
  EXPECT_EQ(Bare(0).facesOf(Material::kBinder), 0u);
  EXPECT_GE(here.facesOf(Material::kBinder), 200u) << "two shelves";
  EXPECT_EQ(here.mostEqual(Material::kBinder), here.facesOf(Material::kBinder));
  const auto binder = [](const Bare &room) {
    return std::find_if(room.jobs.begin(), room.jobs.end(),
                        [](const Job &job) { return job.material == Material::kBinder; })
        ->seed;
  };
  EXPECT_EQ(binder(here), binder(elsewhere));
  EXPECT_LT(Bare(SPHC_SIMULATED_BINDERS, 2).facesOf(Material::kBinder), here.facesOf(Material::kBinder))
      << "people take some away";
}

TEST(SimulatedScene, DoublesAreEqualToTheLastTexel) {
  const Bare plain(0), doubles(SPHC_SIMULATED_DOUBLES);
  EXPECT_EQ(plain.mostEqual(Material::kMagazine), 1u);
  EXPECT_EQ(plain.mostEqual(Material::kPicture), 1u);
  EXPECT_EQ(doubles.mostEqual(Material::kMagazine), 2u) << "things on two equal desks";
  EXPECT_EQ(doubles.mostEqual(Material::kCabinetDoor), 2u);
  EXPECT_GE(doubles.mostEqual(Material::kPicture), 4u) << "posters";
}

TEST(SimulatedScene, AMirrorShowsWhatIsBeforeItBehindIt) {
  const Bare bare(SPHC_SIMULATED_MIRROR);
  ASSERT_EQ(bare.scene.portals.size(), 1u);
  const Shape &glass = bare.scene.shapes[bare.scene.portals[0].shape];
  Vec3f unit, normal;
  facePoint(glass, 3, 0.5f, 0.5f, &unit, &normal);
  const Vec3f middle = worldPoint(glass, unit);
  int checked = 0;
  for (double time_s = 0; time_s < kLap_s; time_s += 0.5) {
    for (const Bare::Ray &ray : bare.look(time_s)) {
      if (ray.hit.portal == 0) continue;
      const Vec3f image = ray.origin + ray.direction * ray.hit.z;
      const float behind = -dot(image - middle, normal);
      EXPECT_GT(behind, 0);
      const Vec3f seen = image + normal * (2 * behind);
      const Shape &solid = bare.scene.shapes[ray.hit.shape];
      if (solid.kind == Kind::kRoom || solid.kind == Kind::kBox) {
        EXPECT_LT(std::fabs(distanceTo(solid, seen)), 0.002f);
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST(SimulatedScene, AWindowShowsTheStreetBeyondTheRangeOfDepth) {
  const Bare bare(SPHC_SIMULATED_WINDOW);
  ASSERT_EQ(bare.scene.portals.size(), 1u);
  ASSERT_EQ(bare.scene.outdoors.size(), 1u);
  int through = 0;
  for (double time_s = 0; time_s < kLap_s; time_s += 0.5) {
    for (const Bare::Ray &ray : bare.look(time_s)) {
      if (ray.hit.portal == 0) continue;
      EXPECT_GT(ray.hit.z * norm(ray.direction), 6.0f);
      ++through;
    }
  }
  EXPECT_GT(through, 50);
}

TEST(SimulatedScene, AnotherArrangementMovesOrTakesWhatPeopleMoveAndNothingElse) {
  const Bare before(0), after(0, 2), again(0, 2);
  const auto centers = [](const Bare &bare) {
    std::set<std::tuple<float, float, float>> all;
    for (const Shape &shape : bare.scene.shapes) all.insert({shape.center.x, shape.center.y, shape.center.z});
    return all;
  };
  EXPECT_EQ(centers(after), centers(again));
  EXPECT_LT(after.scene.shapes.size(), before.scene.shapes.size()) << "some are gone";
  std::vector<std::tuple<float, float, float>> stayed;
  const auto a = centers(before), b = centers(after);
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(stayed));
  const double share = static_cast<double>(stayed.size()) / static_cast<double>(a.size());
  EXPECT_GT(share, 0.4);
  EXPECT_LT(share, 0.9);
  EXPECT_LT(b.size() - stayed.size(), a.size() / 2) << "what moved";
  EXPECT_GT(b.size() - stayed.size(), 20u);
  EXPECT_EQ(before.facesOf(Material::kDoor), after.facesOf(Material::kDoor));
  EXPECT_EQ(before.facesOf(Material::kScreen), after.facesOf(Material::kScreen));
}

}  // namespace
}  // namespace sphc::simulated::test
