// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Camera_h
#define po_Camera_h

#include "Matrix4.h"
#include "Vec3.h"

#include <optional>

namespace po
{
[[nodiscard]] Matrix4 multiply(const Matrix4& a, const Matrix4& b);

/// a (p, 1) without its fourth component.
[[nodiscard]] Vec3d transformPoint(const Matrix4& a, Vec3d p);

/// a (v, 0) without its fourth component.
[[nodiscard]] Vec3d transformVector(const Matrix4& a, Vec3d v);

/// The transpose of the linear part of a times v: with a the inverse of a matrix this is how
/// normals follow that matrix.
[[nodiscard]] Vec3d transformTransposed(const Matrix4& a, Vec3d v);

/// Inverse of a matrix whose last row is (0, 0, 0, 1); nothing if it is singular or not finite.
[[nodiscard]] std::optional<Matrix4> invertAffine(const Matrix4& a);

/// What OpenGL knows about a view: perspective or parallel, on-axis or not, a tile or all of it.
struct Camera
{
  Matrix4 worldToEye; ///< model-view matrix, affine
  Matrix4 eyeToClip;  ///< projection matrix; clip space is -w <= x, y, z <= w
  int width = 0;      ///< pixels of the viewport
  int height = 0;
};

/// The camera of `rows` rows of the view from row `first` (from below) on, so that large pictures
/// can be made in parts.
[[nodiscard]] Camera bandOf(const Camera& camera, int first, int rows);

/// A value that depends linearly on the position in the window.
template <typename T>
struct WindowFunction
{
  T base, dx, dy;

  [[nodiscard]] constexpr T at(double x, double y) const { return base + x * dx + y * dy; }
};

/// Pixels [x0, x1) x [y0, y1); empty where x0 >= x1 or y0 >= y1.
struct PixelRange
{
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// The part of both.
[[nodiscard]] PixelRange intersect(const PixelRange& a, const PixelRange& b);

/// The eye ray of one pixel, in local coordinates: origin + s direction.
struct PrimaryRay
{
  Vec3d origin;         ///< the eye, or the point of the eye plane (parallel projection)
  Vec3d direction;      ///< unit vector
  double nearest;       ///< s of the near plane
  double farthest;      ///< s of the far plane
  double worldPerLocal; ///< t in world units = s * worldPerLocal
  // Clip coordinates z and w at the origin, and their growth with s.
  double originZ, originW, growthZ, growthW;

  /// Depth in the window, 0 at the near and 1 at the far plane.
  [[nodiscard]] double windowDepth(double s) const
  {
    return 0.5 * ((originZ + s * growthZ) / (originW + s * growthW)) + 0.5;
  }
};

/// What rays are made of: functions of the position in the window, in [-1, 1], which give
/// directions of one common, arbitrary scale of length.
struct PrimaryRayFunctions
{
  int width = 0, height = 0;
  bool perspective = false;
  double worldPerLocal = 0; ///< the same for all rays where lengths scale evenly, otherwise 0
  WindowFunction<Vec3d> localOrigin, localDirection, worldDirection;
  // Clip coordinates z and w at the origin of a ray, and their growth along its direction.
  WindowFunction<double> originZ, originW, directionZ, directionW;

  /// Position in the window, in pixels, to [-1, 1].
  [[nodiscard]] double clipX(double x) const { return 2 * x / width - 1; }
  [[nodiscard]] double clipY(double y) const { return 2 * y / height - 1; }
};

/// Makes eye rays through pixel centres, in double precision from the matrices to the ray.
///
/// Pixel (x, y) counts from the lower left corner. A ray is where two planes of eye space meet,
/// (P0 - X P3) e = 0 and (P1 - Y P3) e = 0 with the rows Pi of the projection and X, Y the pixel in
/// [-1, 1]; so the near and far planes, however far apart, cost no digits. Its direction, the cross
/// product of both normals, is linear in X and Y.
class PrimaryRays
{
public:
  /// @param localToWorld affine, any scales and shears
  /// Nothing is returned for a singular matrix or an empty viewport.
  [[nodiscard]] static std::optional<PrimaryRays> make(
    const Camera& camera, const Matrix4& localToWorld);

  [[nodiscard]] int width() const { return f_.width; }
  [[nodiscard]] int height() const { return f_.height; }
  [[nodiscard]] const PrimaryRayFunctions& functions() const { return f_; }

  /// The ray through window position (x, y); pixel i has its centre at i + 1/2.
  [[nodiscard]] PrimaryRay at(double x, double y) const;

  /// Unit vector of the same ray in world space.
  [[nodiscard]] Vec3d worldDirection(double x, double y) const;

  /// Point at distance t (world units) on the same ray in world space.
  [[nodiscard]] Vec3d worldPoint(double x, double y, double t) const;

  /// The part of the window through which points of the box (local) can be seen; maybe too large.
  [[nodiscard]] PixelRange pixelsOfBox(Vec3d low, Vec3d high) const;

  /// Where rays may begin without loss: no ray meets the box (local) at a smaller s.
  [[nodiscard]] double startOfBox(Vec3d low, Vec3d high) const;

  /// Does the near plane cut anything off the box (local)?
  [[nodiscard]] bool isCutByNearPlane(Vec3d low, Vec3d high) const;

  [[nodiscard]] const Matrix4& localToWorld() const { return localToWorld_; }
  [[nodiscard]] const Matrix4& worldToLocal() const { return worldToLocal_; }

private:
  PrimaryRays() = default;
  void setEyeRays(const Matrix4& eyeToClip);
  Matrix4 localToWorld_{}, worldToLocal_{}, localToClip_{};
  PrimaryRayFunctions f_{};
  // In eye and world space, as f_ has them in local space.
  WindowFunction<Vec3d> eyeOrigin_{}, eyeDirection_{}, worldOrigin_{};
};
}

#endif
