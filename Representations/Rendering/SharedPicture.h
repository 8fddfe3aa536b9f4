// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedPicture_h
#define po_SharedPicture_h

#include "Camera.h"
#include "SharedSilhouettes.h"
#include "TracedLayers.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkProp;
class vtkRenderer;

/// Lines in a picture that is composited from those of several processes.
namespace po
{
class ProcessGroup;

/// What one process has of a picture.
struct OwnFrames
{
  std::vector<TracedActor> actors; ///< with a frame of the camera
  Camera camera{};
  bool complete = false; ///< is there a frame of all spheres that are visible?
};

/// Frames of the ray-traced spheres among the props, in the renderer's present view.
[[nodiscard]] OwnFrames framesOf(
  const std::vector<vtkProp*>& props, vtkRenderer* renderer, int width, int height);

/// What one process says about a picture before its lines are found.
struct SilhouetteOffer
{
  bool canShare = false; ///< has it lines to find, in spheres alone, and all frames for that?
  int width = 0, height = 0;
  SilhouetteScale scale; ///< zeros where it knows of no spheres
};

/// The scale of the ray-traced spheres among the props that are visible, zeros if there are none.
[[nodiscard]] SilhouetteScale scaleOf(const std::vector<vtkProp*>& props);

/// The scale to go by, if all processes can share in the lines of one picture; all must call it,
/// and all get the same.
[[nodiscard]] std::optional<SilhouetteScale> agreedScale(
  const SilhouetteOffer& own, const ProcessGroup& group);

/// Is it so for all processes? All must call it, and all get the same.
[[nodiscard]] bool isSoForAll(bool own, const ProcessGroup& group);

/// Does what the processes do together for lines.
/// @return what went wrong, the same on all processes; empty if nothing did
[[nodiscard]] std::string runForLines(const ProcessGroup& group, const std::function<void()>& work);

/// Finds the lines at the process `destination`, or at all if it is negative.
/// @param placed with window depths
/// @return what went wrong, the same on all processes; empty if nothing did
[[nodiscard]] std::string findTogether(const OwnFrames& own, const SilhouetteRule& rule,
  const ProcessGroup& group, int destination, bool placed, SharedSilhouettes& silhouettes);

/// What lines are coloured by that lie around the spheres of this process.
struct OwnColors
{
  const std::uint8_t* rgba = nullptr; ///< of its frames, null if it has none
  bool all = false;                   ///< are they wanted of all lines, not of smooth rims alone?
};

/// The same for all processes, placed and with the colours in front of the lines.
[[nodiscard]] std::string findWithColors(const OwnFrames& own, const SilhouetteRule& rule,
  const ProcessGroup& group, const OwnColors& colors, SharedSilhouettes& silhouettes);
}

#endif
