#include "film/picture_layout.h"

namespace tessera {

std::span<const PlaneSpec> planeSpecs() {
    static constexpr PlaneSpec specs[] = {
        {Aov::z, "Z", 1, &picture_planes::z},
        {Aov::normal, "N", 3, &picture_planes::normal},
        {Aov::object, "object.id", 1, &picture_planes::object},
        {Aov::patch, "patch.id", 1, &picture_planes::patch_id},
        {Aov::uv, "uv", 2, &picture_planes::uv},
    };
    return specs;
}

PictureLayout layOutPicture(int width, int height, Aov aovs) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    PictureLayout layout;
    layout.floats = 4 * pixels;
    const std::span<const PlaneSpec> specs = planeSpecs();
    for (std::size_t k = 0; k < specs.size(); ++k) {
        const PlaneSpec& spec = specs[k];
        if (!contains(aovs, spec.aov)) continue;
        layout.places[k] = layout.floats;
        layout.planes.*(spec.place) = static_cast<uint>(layout.floats);
        layout.floats += static_cast<std::uint64_t>(spec.channels) * pixels;
    }
    return layout;
}

}  // namespace tessera
