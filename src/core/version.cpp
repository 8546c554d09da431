#include "tessera/renderer.h"

namespace tessera {

std::string_view versionString() { return "0.1.0"; }

}  // namespace tessera
