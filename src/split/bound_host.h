// The kernels' bounding, compiled as C++: the same decisions to the bit.
#pragma once

#include "core/frame_shared.h"
#include "split/range_shared.h"

namespace tessera {

// ACTION_* of a range. `net`: its patch's eye-space control points, x[count], y[count], z[count] with count 16 or 20, net order.
[[nodiscard]] int boundOnHost(const frame_params& frame, const float* net, int count, const range_t& range);

}  // namespace tessera
