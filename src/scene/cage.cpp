// Names of what a cage has.
#include "tessera/cage.h"

namespace tessera {

std::string_view name(SubdivisionScheme scheme) {
    switch (scheme) {
        case SubdivisionScheme::catmullClark:
            return "catmull-clark";
        case SubdivisionScheme::loop:
            return "loop";
        case SubdivisionScheme::bilinear:
            return "bilinear";
        case SubdivisionScheme::none:
            return "none";
    }
    return "unknown";
}

}  // namespace tessera
