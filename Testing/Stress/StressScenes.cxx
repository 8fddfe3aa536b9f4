// SPDX-License-Identifier: BSD-3-Clause
#include "StressScenes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace stress
{
namespace
{
constexpr std::size_t MostWatched = 12;

class Numbers
{
public:
  explicit Numbers(std::uint64_t seed)
    : engine_(seed)
  {
  }
  double between(double low, double high)
  {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3d inCube(double half)
  {
    const double x = between(-half, half);
    const double y = between(-half, half);
    return { x, y, between(-half, half) };
  }

private:
  std::mt19937_64 engine_;
};

/// Watches a dozen, evenly spread over the list.
Scene make(std::string name, std::vector<Ball> balls)
{
  Scene scene{ std::move(name), std::move(balls), {}, {}, 1 };
  const std::size_t count = std::min(scene.balls.size(), MostWatched);
  for (std::size_t i = 0; i < count; ++i)
  {
    scene.watched.push_back(i * scene.balls.size() / count);
  }
  return scene;
}

/// Overlaps, contacts and unequal radii.
std::vector<Ball> cloud(std::size_t count, double half, std::uint64_t seed)
{
  Numbers numbers(seed);
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3d center = numbers.inCube(half);
    balls.push_back({ center, numbers.between(0.4, 1.6) });
  }
  return balls;
}

std::vector<Ball> lattice(int side, double spacing)
{
  std::vector<Ball> balls;
  for (int i = 0; i < side * side * side; ++i)
  {
    const Vec3d place{ double(i % side), double(i / side % side), double(i / side / side) };
    const double middle = (side - 1) / 2.0;
    balls.push_back({ spacing * (place - Vec3d{ middle, middle, middle }), 1 });
  }
  return balls;
}

void addShell(std::vector<Ball>& balls, Vec3d middle, double distance, double radius, int count)
{
  const double golden = 3.14159265358979323846 * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i)
  {
    const double z = 1 - (2 * i + 1.0) / count;
    const double r = std::sqrt(1 - z * z);
    balls.push_back(
      { middle + distance * Vec3d{ r * std::cos(golden * i), r * std::sin(golden * i), z },
        radius });
  }
}

Scene sealed()
{
  std::vector<Ball> balls = cloud(8, 2.5, 21);
  addShell(balls, {}, 9, 2, 500);
  Scene scene = make("closed shell", std::move(balls));
  scene.watched = { 0, 1, 2, 3, 4, 5, 6, 7, 100, 200, 300, 400 };
  scene.sealed = { 0, 1, 2, 3, 4, 5, 6, 7 };
  return scene;
}

Scene pairsBy(const std::string& name, double distance)
{
  std::vector<Ball> balls = cloud(20, 4, 31);
  for (int i = 0; i < 12; ++i)
  {
    const Ball other = balls[static_cast<std::size_t>(i)];
    const Vec3d aside = po::normalized(Vec3d{ 1.0 + i, 3.0 - i, double(i % 3) });
    balls.push_back({ other.center + distance * other.radius * aside, other.radius });
  }
  return make(name, std::move(balls));
}

Scene duplicates()
{
  std::vector<Ball> balls = cloud(24, 4, 41);
  const Ball many = balls[5];
  balls.insert(balls.end(), 3000, many);
  Scene scene = make("3000 at one place", std::move(balls));
  scene.watched = { 0, 1, 2, 3, 4, 5, 6, 7, 24, 1000, 2000, 3023 };
  return scene;
}

Scene nested()
{
  std::vector<Ball> balls = cloud(12, 4, 51);
  for (const double radius : { 1.3, 1.0, 0.999999, 0.5, 1e-3 })
  {
    balls.push_back({ { 0.5, -0.25, 0.125 }, radius });
    balls.push_back({ { 7, 0, 0 }, radius });
  }
  return make("nested concentric", std::move(balls));
}

/// Touching from within, almost buried, sticking out by little.
Scene inside()
{
  std::vector<Ball> balls;
  for (int i = 0; i < 6; ++i)
  {
    const Vec3d middle{ 5.0 * i, 0.5 * i, 0 };
    const double out[] = { 0, 1e-7, -1e-7, 1e-3, -1e-3, 0.3 };
    const Vec3d way = po::normalized(Vec3d{ 1, 1.0 + i, 2 });
    balls.push_back({ middle, 2 });
    balls.push_back({ middle + (1 + out[i]) * way, 1 });
  }
  return make("one inside another", std::move(balls));
}

Scene chain()
{
  std::vector<Ball> balls;
  const Vec3d way = po::normalized(Vec3d{ 1, 0.3, -0.7 });
  for (int i = 0; i < 200; ++i)
  {
    balls.push_back({ (2.0 * i - 200) * way, 1 });
  }
  return make("chain", std::move(balls));
}

Scene line()
{
  std::vector<Ball> balls;
  for (int i = 0; i < 100; ++i)
  {
    balls.push_back({ { 10.0 * i - 500, 0, 0 }, i % 7 == 0 ? 4.0 : 1.0 });
  }
  return make("line", std::move(balls));
}

Scene plane()
{
  std::vector<Ball> balls;
  for (int i = 0; i < 225; ++i)
  {
    balls.push_back({ { 2.0 * (i % 15) - 14, 2.0 * (i / 15) - 14, 0 }, 1 });
  }
  return make("plane", std::move(balls));
}

Scene onePoint()
{
  Numbers numbers(61);
  std::vector<Ball> balls;
  for (int i = 0; i < 60; ++i)
  {
    balls.push_back({ { 1, 2, 3 }, i < 10 ? 2.0 : numbers.between(0.1, 1.9) });
  }
  return make("all at one point", std::move(balls));
}

/// Thousands of balls, most of which see nothing, and some through gaps only: what can be skipped
/// is. Watched are those of the first three layers at a corner, an edge and the middle of a side.
Scene solid()
{
  Scene scene = make("solid of 4096", lattice(16, 1.9));
  scene.watched.clear();
  const auto watch = [&](std::size_t x, std::size_t y, std::size_t z)
  { scene.watched.push_back(x + 16 * (y + 16 * z)); };
  for (const std::size_t layer : { 0, 1, 2 })
  {
    watch(layer, layer, layer);
    watch(7, layer, layer);
    watch(8, 7, layer);
    watch(15 - layer, 9, 6);
  }
  return scene;
}

/// Balls that overlap as the atoms of a molecule do; watched are those at the top.
Scene dense()
{
  Scene scene{ "dense cloud of 2000", cloud(2000, 8, 121), {}, {}, 1 };
  for (std::size_t i = 0; i < scene.balls.size() && scene.watched.size() < MostWatched; ++i)
  {
    if (scene.balls[i].center.z + scene.balls[i].radius > 8.2)
    {
      scene.watched.push_back(i);
    }
  }
  return scene;
}

/// Contacts at both poles, on the axes and at the seam of the texture.
Scene axes()
{
  std::vector<Ball> balls{ { {}, 1 } };
  for (const double side : { -2.0, 2.0 })
  {
    balls.push_back({ { side, 0, 0 }, 1 });
    balls.push_back({ { 0, side, 0 }, 1 });
    balls.push_back({ { 0, 0, side }, 1 });
  }
  balls.push_back({ { 3, 3e-17, 0 }, 0.5 });
  balls.push_back({ { 3, -1e-9, 3 }, 0.5 });
  return make("poles, axes, seam", std::move(balls));
}

/// Balls whose tops all lie in the plane that touches the first one's pole, and balls that touch
/// the planes of its equator: rays along these planes graze all of them.
Scene grazing()
{
  Numbers numbers(71);
  std::vector<Ball> balls{ { {}, 1 } };
  for (int i = 0; i < 80; ++i)
  {
    const double radius = numbers.between(0.2, 1.5);
    const double angle = numbers.between(0, 6.28);
    const double away = 2 + 0.25 * i;
    const double height = i % 2 == 0 ? 1 - radius : -1 + radius;
    balls.push_back({ { away * std::cos(angle), away * std::sin(angle), height }, radius });
  }
  Scene scene = make("grazing", std::move(balls));
  scene.watched[1] = 1;
  return scene;
}

/// Grains on a ball that is a million times as large.
Scene ratio()
{
  Numbers numbers(81);
  constexpr double large = 1e6;
  std::vector<Ball> balls{ { { 0, 0, -large }, large } };
  for (int i = 0; i < 60; ++i)
  {
    const Vec3d p = numbers.inCube(6);
    const double radius = i % 9 == 0 ? 3.0 : 1.0;
    // Resting on the large ball: (R + r)^2 = x^2 + y^2 + (z + R)^2.
    const double sum = large + radius;
    const double square = p.x * p.x + p.y * p.y;
    const double height = radius - square / (sum + std::sqrt(sum * sum - square));
    balls.push_back({ { p.x, p.y, i < 40 ? height : height + 2 + p.z }, radius });
  }
  Scene scene = make("radii 1 : 1,000,000", std::move(balls));
  scene.watched = { 1, 2, 3, 5, 8, 10, 19, 28, 37, 41, 46, 55 };
  return scene;
}

/// Copies of a cloud that lie far apart.
Scene apart(const std::string& name, double extent, bool stray)
{
  std::vector<Ball> balls = cloud(60, 4, 91);
  const Vec3d far{ extent, -0.7 * extent, 0.3 * extent };
  const std::vector<Ball> copy = stray ? std::vector<Ball>{ { far, 1 } } : cloud(60, 4, 91);
  for (const Ball& b : copy)
  {
    balls.push_back({ stray ? far : b.center + far, b.radius });
  }
  return make(name, std::move(balls));
}

/// A large ball that takes a ninth of the sky from two clouds of small ones, 15,000 of their radii
/// away: more than one frame of floats spans.
Scene shade()
{
  Numbers numbers(111);
  std::vector<Ball> balls{ { {}, 5000 } };
  for (int i = 0; i < 5000; ++i)
  {
    const Vec3d middle{ i % 2 == 0 ? 15000.0 : -15000.0, 0, 0 };
    balls.push_back({ middle + numbers.inCube(60), 1 });
  }
  return make("a ball shades far clouds", std::move(balls));
}

/// Short chains along a line a million radii long.
Scene longChain()
{
  std::vector<Ball> balls;
  const Vec3d way = po::normalized(Vec3d{ 3, -1, 2 });
  for (int i = 0; i < 240; ++i)
  {
    balls.push_back({ (50000.0 * (i / 12) + 2.0 * (i % 12)) * way, 1 });
  }
  Scene scene = make("chains over 1e6 radii", std::move(balls));
  for (std::size_t i = 0; i < scene.watched.size(); ++i)
  {
    scene.watched[i] = 20 * i + i;
  }
  return scene;
}
}

Scene layers()
{
  constexpr int side = 100;
  constexpr double spacing = 1.3;
  Numbers numbers(101);
  Scene scene{ "layers of 40000", {}, {}, {}, 1 };
  for (int i = 0; i < 4 * side * side; ++i)
  {
    const double x = spacing * (i % side - side / 2.0);
    const double y = spacing * (i / side % side - side / 2.0);
    const double z = spacing * (i / side / side) + numbers.between(-0.4, 0.4);
    scene.balls.push_back({ { x, y, z }, 1 });
  }
  for (std::size_t k = 0; k < MostWatched; ++k)
  {
    scene.watched.push_back((k % 3 == 0 ? 2 : 3) * side * side + (44 + k) * side + 46 + k % 5);
  }
  return scene;
}

std::vector<Scene> scenes()
{
  std::vector<Scene> all;
  all.push_back(make("cloud", cloud(60, 4, 91)));
  all.push_back(make("touching", lattice(5, 2)));
  all.push_back(make("gap 1e-7 r", lattice(5, 2 + 1e-7)));
  for (const auto& [name, overlap] : { std::pair("overlap 1e-7 r", 1e-7),
         std::pair("overlap 1e-5 r", 1e-5), std::pair("overlap 1e-3 r", 1e-3),
         std::pair("overlap 0.1 r", 0.1), std::pair("overlap 0.9 r", 0.9) })
  {
    all.push_back(make(name, lattice(4, 2 - overlap)));
  }
  all.push_back(pairsBy("coincident pairs", 0));
  all.push_back(pairsBy("pairs 1e-7 r apart", 1e-7));
  all.push_back(pairsBy("pairs 1e-3 r apart", 1e-3));
  all.push_back(duplicates());
  all.push_back(nested());
  all.push_back(inside());
  all.push_back(chain());
  all.push_back(line());
  all.push_back(plane());
  all.push_back(solid());
  all.push_back(dense());
  all.push_back(onePoint());
  all.push_back(axes());
  all.push_back(grazing());
  all.push_back(sealed());
  all.push_back(ratio());
  all.push_back(shade());
  all.push_back(longChain());
  all.push_back(apart("two clouds, 1e6 radii apart", 1e6, false));
  all.push_back(apart("two clouds, 1e9 radii apart", 1e9, false));
  all.push_back(apart("a cloud, a stray 1e7 radii away", 1e7, true));
  all.push_back(apart("a cloud, a stray 1e12 radii away", 1e12, true));
  all.push_back({ "a lone ball", { { { 0.1, 0.2, 0.3 }, 1 } }, { 0 }, {}, 1 });
  return all;
}

std::vector<Placement> placements()
{
  return { { "unit, at the origin", 1, 0, false }, { "unit 1e-30", 1e-30, 0, false },
    { "unit 1e-10, 1e6 radii away", 1e-10, 1e6, false }, { "unit 1e+30", 1e30, 0, false },
    { "1e9 radii away", 1, 1e9, false }, { "unit 1e+20, 1e12 radii away", 1e20, 1e12, false },
    { "floats, 1e4 radii away", 1, 1e4, true } };
}

std::vector<Ball> place(const Scene& scene, const Placement& placement)
{
  const double length = placement.offset * scene.reach;
  const Vec3d shift{ length, -2 * length / 3, length / 3 };
  std::vector<Ball> balls = scene.balls;
  for (Ball& b : balls)
  {
    b.center = placement.unit * (b.center + shift);
    b.radius *= placement.unit;
    if (placement.floatPoints)
    {
      b.center = b.center.as<float>().as<double>();
    }
  }
  return balls;
}

double inputError(const Scene& scene, const Placement& placement)
{
  // Of the differences to the first ball, so that the shift itself does not count.
  const std::vector<Ball> placed = place(scene, placement);
  double worst = 0;
  for (std::size_t i = 0; i < placed.size(); ++i)
  {
    const Vec3d now = (1 / placement.unit) * (placed[i].center - placed[0].center);
    const Vec3d before = scene.balls[i].center - scene.balls[0].center;
    worst = std::max(worst, po::length(now - before) / scene.balls[i].radius);
  }
  return worst;
}
}
