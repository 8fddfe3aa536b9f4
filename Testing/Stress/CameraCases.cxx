// SPDX-License-Identifier: BSD-3-Clause
#include "CameraCases.h"

#include "SphereRenderer.h"
#include "StressScenes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stress
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
using Real = long double;

struct RealVector
{
  Real x, y, z;
};

RealVector operator-(RealVector a, RealVector b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

Real dot(RealVector a, RealVector b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Half the height of the picture at z = -1 (perspective) or anywhere (parallel).
double halfHeight(const View& view)
{
  return view.angle > 0 ? std::tan(view.angle * Pi / 360) : view.half;
}

po::Camera cameraOf(const View& view)
{
  const double c = std::cos(view.turn);
  const double s = std::sin(view.turn);
  const Vec3d e = view.eye;
  po::Camera camera;
  camera.worldToEye = { c, 0, -s, -(c * e.x - s * e.z), 0, 1, 0, -e.y, s, 0, c,
    -(s * e.x + c * e.z), 0, 0, 0, 1 };
  const int columns = view.tileSize > 0 ? view.tileSize : view.width;
  const int rows = view.tileSize > 0 ? view.tileSize : view.height;
  const double high = halfHeight(view);
  const double wide = high * view.width / view.height;
  const double left = wide * (2.0 * view.tileX / view.width - 1);
  const double right = wide * (2.0 * (view.tileX + columns) / view.width - 1);
  const double bottom = high * (2.0 * view.tileY / view.height - 1);
  const double top = high * (2.0 * (view.tileY + rows) / view.height - 1);
  const double n = view.zNear;
  const double f = view.zFar;
  const double across = right - left;
  const double up = top - bottom;
  if (view.angle > 0)
  {
    camera.eyeToClip = { 2 / across, 0, (right + left) / across, 0, 0, 2 / up, (top + bottom) / up,
      0, 0, 0, -(f + n) / (f - n), -2 * f * n / (f - n), 0, 0, -1, 0 };
  }
  else
  {
    camera.eyeToClip = { 2 / across, 0, 0, -(right + left) / across, 0, 2 / up, 0,
      -(top + bottom) / up, 0, 0, -2 / (f - n), -(f + n) / (f - n), 0, 0, 0, 1 };
  }
  camera.width = columns;
  camera.height = rows;
  return camera;
}

/// The ray of a pixel of the part, straight from what the camera means.
void makeRay(const View& view, int x, int y, RealVector& origin, RealVector& way, Real& slope)
{
  const Real high = halfHeight(view);
  const Real wide = high * view.width / view.height;
  const Real u = wide * (2 * (view.tileX + x + 0.5L) / view.width - 1);
  const Real v = high * (2 * (view.tileY + y + 0.5L) / view.height - 1);
  const Real c = std::cos(view.turn);
  const Real s = std::sin(view.turn);
  const auto turned = [c, s](RealVector p) // from the eye's frame to the world's
  {
    return RealVector{ c * p.x + s * p.z, p.y, -s * p.x + c * p.z };
  };
  const bool parallel = view.angle <= 0;
  const RealVector aside = turned({ u, v, 0 });
  origin = { view.eye.x, view.eye.y, view.eye.z };
  if (parallel)
  {
    origin = { origin.x + aside.x, origin.y + aside.y, origin.z + aside.z };
    way = turned({ 0, 0, -1 });
    slope = 1;
    return;
  }
  slope = std::sqrt(u * u + v * v + 1); // length of the ray for each unit of depth
  way = turned({ u / slope, v / slope, -1 / slope });
}

struct Seen
{
  Real t = std::numeric_limits<Real>::infinity();
  std::size_t ball = 0;
  bool nearEdge = false; ///< a small error could change what is seen
};

/// The nearest front between the planes. A ball that the near plane cuts is passed.
Seen look(const View& view, RealVector origin, RealVector way, Real slope, double tolerance)
{
  Seen seen;
  Real second = seen.t;
  for (std::size_t i = 0; i < view.balls.size(); ++i)
  {
    const Ball& b = view.balls[i];
    const RealVector toCenter = RealVector{ b.center.x, b.center.y, b.center.z } - origin;
    const Real along = dot(toCenter, way);
    const RealVector foot{ toCenter.x - along * way.x, toCenter.y - along * way.y,
      toCenter.z - along * way.z };
    const Real miss = std::sqrt(dot(foot, foot));
    const Real slack = tolerance * (b.radius + std::abs(along));
    const Real front = along - std::sqrt(std::max(Real(0), (b.radius - miss) * (b.radius + miss)));
    const Real low = view.zNear * slope;
    const Real high = view.zFar * slope;
    const bool atEdge = std::abs(miss - b.radius) < slack;
    const bool atPlane = std::abs(front - low) < slack || std::abs(front - high) < slack;
    seen.nearEdge = seen.nearEdge || atEdge || (miss < b.radius && atPlane);
    if (miss < b.radius && front >= low && front <= high && front < second)
    {
      second = front;
      if (front < seen.t)
      {
        second = seen.t;
        seen.t = front;
        seen.ball = i;
      }
    }
  }
  seen.nearEdge = seen.nearEdge || second - seen.t < tolerance * seen.t;
  return seen;
}

std::vector<Ball> cloudAt(Vec3d middle, double unit)
{
  std::vector<Ball> balls = scenes().front().balls;
  for (Ball& b : balls)
  {
    b = { middle + unit * b.center, unit * b.radius };
  }
  return balls;
}

View at(std::string name, std::vector<Ball> balls, Vec3d eye)
{
  View view;
  view.name = std::move(name);
  view.balls = std::move(balls);
  view.eye = eye;
  return view;
}
}

std::vector<View> views()
{
  std::vector<View> all;
  const auto add = [&](std::string name, auto change)
  {
    View view = at(std::move(name), cloudAt({}, 1), { 0, 0, 20 });
    change(view);
    all.push_back(view);
  };
  add("from 20 radii", [](View&) {});
  add("camera inside a ball",
    [](View& v)
    {
      v.eye = v.balls[7].center;
      v.zNear = 1e-3;
    });
  add("near plane inside a ball",
    [](View& v)
    {
      v.zNear = 19;
      v.turn = 0.05;
    });
  add("1e7 radii away",
    [](View& v)
    {
      v.eye = { 0, 0, 1e7 };
      v.angle = 6e-5;
      v.zNear = 1e7 - 10;
      v.zFar = 1e7 + 10;
    });
  add("1e7 radii away, near plane at 1",
    [](View& v)
    {
      v.eye = { 0, 0, 1e7 };
      v.angle = 6e-5;
      v.zNear = 1;
      v.zFar = 2e7;
    });
  add("field of view 0.001 degrees",
    [](View& v)
    {
      v.eye = { 0.3, 0.1, 4e5 };
      v.angle = 1e-3;
      v.zNear = 3e5;
      v.zFar = 5e5;
    });
  add("field of view 179 degrees",
    [](View& v)
    {
      v.eye = { 0, 0, 4 };
      v.angle = 179;
    });
  for (const double half : { 1e-6, 1e-3, 5.0, 1e6 })
  {
    add("parallel, half height " +
        std::string(half < 1e-5 ? "1e-6"
            : half < 1          ? "1e-3"
            : half < 10         ? "5"
                                : "1e6"),
      [half](View& v)
      {
        v.angle = 0;
        v.half = half;
        v.turn = 0.3;
        v.eye = { 6, 0, 19 };
      });
  }
  add("1 x 1 pixel", [](View& v) { v.width = v.height = 1; });
  add("16384 x 16384 pixels, lower left of the middle",
    [](View& v)
    {
      v.width = v.height = 16384;
      v.tileX = v.tileY = 8192 - 128;
      v.tileSize = 128;
    });
  add("16384 x 16384 pixels, upper right tile",
    [](View& v)
    {
      v.width = v.height = 16384;
      v.tileX = v.tileY = 16384 - 128;
      v.tileSize = 128;
      v.angle = 12;
    });
  for (const auto& [name, unit] : { std::pair("unit 1e-30", 1e-30), std::pair("unit 1e+30", 1e30) })
  {
    View view = at(name, cloudAt({}, unit), { 0, 0, 20 * unit });
    view.zNear *= unit;
    view.zFar *= unit;
    all.push_back(view);
  }
  all.push_back(
    at("1e6 radii from the origin", cloudAt({ 1e6, -7e5, 3e5 }, 1), { 1e6, -7e5, 3e5 + 20 }));
  std::vector<Ball> two = cloudAt({}, 1);
  const std::vector<Ball> far = cloudAt({ 1e9, 2e8, -5e8 }, 1);
  two.insert(two.end(), far.begin(), far.end());
  all.push_back(at("two clouds, 1e9 radii apart: the first", two, { 0, 0, 20 }));
  all.push_back(at("two clouds, 1e9 radii apart: the second", two, { 1e9, 2e8, -5e8 + 20 }));
  return all;
}

FrameOutcome runView(const View& view)
{
  po::SphereRenderer renderer;
  renderer.setCloud(po::makeSphereCloud(
    view.balls.size(), [&](std::size_t i) { return view.balls[i].center; },
    [&](std::size_t i) { return view.balls[i].radius; }));
  const po::Matrix4 identity{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  FrameOutcome outcome;
  if (!renderer.trace(cameraOf(view), identity))
  {
    outcome.wrong = std::numeric_limits<std::size_t>::max();
    return outcome;
  }
  const po::TracedFrame& frame = renderer.frame();
  // Positions in the world, those of the eye too, are right to 2^-53 of their own; places in the
  // cloud to 1/8000 of a mean radius at worst, here to 1e-6.
  const double reach =
    std::max({ std::abs(view.eye.x), std::abs(view.eye.y), std::abs(view.eye.z) });
  for (int y = 0; y < frame.height; ++y)
  {
    for (int x = 0; x < frame.width; ++x)
    {
      RealVector origin{};
      RealVector way{};
      Real slope = 1;
      makeRay(view, x, y, origin, way, slope);
      const double radius = view.balls.front().radius;
      const double tolerance = 4e-6 * radius / (radius + reach) + 1e-14;
      const Seen seen = look(view, origin, way, slope, tolerance);
      const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
        static_cast<std::size_t>(x);
      ++outcome.pixels;
      const bool hit = std::isfinite(seen.t);
      outcome.hits += hit;
      const bool found = frame.sphere[pixel] != po::SphereScene::None;
      if (seen.nearEdge)
      {
        continue;
      }
      if (hit != found || (hit && frame.sphere[pixel] != seen.ball))
      {
        ++outcome.wrong;
      }
      else if (hit)
      {
        const double error = static_cast<double>(std::abs(frame.t[pixel] - seen.t));
        outcome.depth = std::max(outcome.depth, error / view.balls[seen.ball].radius);
      }
    }
  }
  return outcome;
}
}
