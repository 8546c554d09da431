// Uses the installed libraries as an engine would: lists the devices, renders the built-in teapot, checks that it can be seen, and makes
// patches of subdivision surfaces.
#include <tessera/device.h>
#include <tessera/error.h>
#include <tessera/renderer.h>
#include <tessera/subdivision.h>

#include <cstddef>
#include <iostream>

namespace {

int renderTeapot() {
    for (const tessera::DeviceInfo& device : tessera::listDevices()) std::cout << device.index << ": " << device.name << "\n";

    tessera::Renderer renderer;
    const tessera::Scene scene = tessera::builtinScene("teapot");
    renderer.setScene(scene);
    const tessera::Camera camera = scene.cameras.empty() ? tessera::framingCamera(scene, 45.0F) : scene.cameras.front();
    tessera::RenderOptions options;
    options.width = 32;
    options.height = 32;
    const tessera::Frame frame = renderer.render(camera, options);

    const tessera::Plane* colour = frame.plane("rgba");
    if (colour == nullptr || colour->values.size() != 32U * 32U * 4U) {
        std::cerr << "the frame has no colour of its size\n";
        return 1;
    }
    std::size_t covered = 0;
    for (std::size_t i = 3; i < colour->values.size(); i += 4) covered += colour->values[i] > 0.5F ? 1 : 0;
    std::cout << "Tessera " << tessera::versionString() << ", " << covered << " of 1024 pixels covered\n";
    if (covered < 100 || covered > 1000) {
        std::cerr << "this is no teapot\n";
        return 1;
    }
    return 0;
}

int subdivideCubes() {
    tessera::Scene scene = tessera::builtinScene("cube_creases");
    for (const tessera::CageReport& report : tessera::subdivide(scene)) {
        if (report.patches >= report.faces) continue;
        std::cerr << "cage " << report.cage << " has too few patches\n";
        return 1;
    }
    scene.validate();
    return 0;
}

}  // namespace

int main() {
    try {
        return renderTeapot() + subdivideCubes();
    } catch (const tessera::Error& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
