// How the library tells its caller how far a frame is.
#pragma once

#include <functional>
#include <string_view>

namespace tessera {

// Called from the thread that called render(), whenever it looks at the device's counts: up to
// some thousand times a second, so it should do little.
// `stage` names what runs ("split and dice", "shade"); `fraction` is 0 to 1 and never falls within a frame.
using Progress = std::function<void(std::string_view stage, double fraction)>;

}  // namespace tessera
