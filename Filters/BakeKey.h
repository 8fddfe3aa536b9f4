// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeKey_h
#define po_BakeKey_h

#include "BakeMethods.h"

#include <string>

namespace po
{
/// 32 hexadecimal digits that stand for all that the result of bakeByMethod depends on: the spheres
/// as the bake sees them, occluders, every setting, the processes; not the number of threads, nor
/// what else the data set holds. Different for each process of the group, each of which keeps a
/// result of its own.
/// @param method the one that is used, not Automatic
[[nodiscard]] std::string bakeKey(int method, const BakeTask& task, const ProcessGroup& group);

/// The same for what the textures of single particles depend on beside the spheres and triangles
/// around them: the frame, the method, and the settings but for those of dilation and storage.
[[nodiscard]] std::string textureKey(int method, const BakeTask& task);
}

#endif
