// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_StressCase_h
#define po_StressCase_h

#include "StressScenes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stress
{
/// Texture resolution of all cases: rows at both poles, a seam, and texels on all axes.
inline constexpr int Resolution = 6;
inline constexpr std::size_t Texels = Resolution * Resolution;

enum class Method
{
  Reference,
  Sweep,
  Embree
};
inline constexpr Method Methods[] = { Method::Reference, Method::Sweep, Method::Embree };
[[nodiscard]] const char* nameOf(Method method);

/// Textures of the watched balls, [watched][Texels].
struct Baked
{
  std::vector<float> values;
  std::vector<float> shares;
};

/// Work of a bake: rays a texel (Reference) or directions (the others).
[[nodiscard]] int usualWork(Method method);

/// Bakes the balls with the product. Those that cannot be baked have shares of -1.
[[nodiscard]] Baked bake(const std::vector<Ball>& balls, const std::vector<std::size_t>& watched,
  Method method, int work, std::uint64_t seed = 1, double maximumDistance = 0);

/// What the judge finds of the watched balls.
struct Judgement
{
  std::vector<judge::Texel> texels; ///< [watched][Texels]
  std::vector<bool> open;           ///< those that nothing can darken, for certain
};

[[nodiscard]] Judgement judgeOf(const std::vector<Ball>& balls,
  const std::vector<std::size_t>& watched, int points, double maximumDistance = 0);

/// How far a bake is from the judge.
struct Outcome
{
  std::size_t texels = 0;      ///< compared: those with something outside other balls
  std::size_t open = 0;        ///< of these, open for certain
  std::size_t selfHits = 0;    ///< of these, not 1
  std::size_t leaks = 0;       ///< texels of sealed balls that are not 0
  double rms = 0;              ///< error over the visible area, without the judge's part
  double bias = 0;             ///< mean error over the visible area
  double biasError = 0;        ///< the standard error of that: of the judge, and what rays leave
  double worstZ = 0;           ///< of all texels, see zOf()
  std::vector<double> squares; ///< [watched][Texels] weighted squared errors, for paired tests
};

[[nodiscard]] Outcome compare(
  const Scene& scene, const Judgement& judgement, const Baked& baked, double independentRays);

/// Rays whose error is that of the estimator, at most: all of Reference's (stratified ones scatter
/// less than independent ones); directions that are spread evenly, weighted with the cosine, count
/// 3/8: half of them face a texel, and (mean w)^2 / mean w^2 = 3/4 over these.
[[nodiscard]] double independentRays(Method method, int work);

/// Deviation of two shares a of n and b of m independent trials, in standard deviations: the signed
/// root of the likelihood ratio, which holds for small counts too.
[[nodiscard]] double zOf(double a, double n, double b, double m);

/// The deviation that the largest of `count` independent standard normal ones exceeds with a
/// probability of `risk` (Sidak).
[[nodiscard]] double sidakBound(std::size_t count, double risk);

/// All methods in one scene and placement.
struct Row
{
  Placement placement;
  double inputError = 0; ///< in radii: what the input itself has lost
  Outcome outcomes[3];   ///< by method
};

/// Rays of the judge for a texel.
inline constexpr int JudgePoints = 1024;

/// Bakes and judges a scene wherever it is put; the first row is the scene itself.
[[nodiscard]] std::vector<Row> runScene(const Scene& scene);

/// How much larger the squared errors of `outcome` are than those of `base`, in standard errors of
/// their mean difference.
[[nodiscard]] double growth(const Outcome& outcome, const Outcome& base);
}

#endif
