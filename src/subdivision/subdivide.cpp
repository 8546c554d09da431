// A scene's cages made meshes.
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/text.h"
#include "subdivision/cage_meshes.h"
#include "tessera/error.h"
#include "tessera/subdivision.h"

namespace tessera {

namespace {

using MeshesOfCages = std::map<std::string, std::vector<Mesh>, std::less<>>;

// `wanted`, with a number where that is taken; taken from now on.
std::string freeName(const std::string& wanted, std::set<std::string, std::less<>>& taken) {
    std::string name = wanted;
    for (std::size_t number = 2; !taken.insert(name).second; ++number) name = wanted + " " + std::to_string(number);
    return name;
}

std::set<std::string, std::less<>> meshNames(const Scene& scene) {
    std::set<std::string, std::less<>> names;
    for (const Mesh& mesh : scene.meshes) names.insert(mesh.name);
    for (const Cage& cage : scene.cages) {
        if (!names.insert(cage.name).second) {
            throw Error("cage " + quotedName(cage.name) + ": the name is used twice; give each mesh and cage its own");
        }
    }
    return names;
}

CageReport meshCage(const Cage& cage, const SubdivisionOptions& options, bool placed, MeshesOfCages& made) {
    CageReport report;
    report.cage = cage.name;
    std::vector<Mesh>& meshes = made[cage.name];
    if (!placed) {
        report.notes.emplace_back("no object places it: left out");
        return report;
    }
    if (options.scheme.has_value() && *options.scheme != cage.scheme) {
        Cage other = cage;
        other.scheme = *options.scheme;
        meshes = subdivision::cageMeshes(other, options, report);
    } else {
        meshes = subdivision::cageMeshes(cage, options, report);
    }
    if (meshes.empty()) report.notes.emplace_back("no face of it can be drawn: left out, with the objects that place it");
    return report;
}

// Objects that place what was made of their cages; those of cages of which nothing was are left out.
std::vector<Object> placeMeshes(const std::vector<Object>& objects, const MeshesOfCages& made) {
    std::set<std::string, std::less<>> taken;
    for (const Object& object : objects) taken.insert(object.name);
    std::vector<Object> placed;
    for (const Object& object : objects) {
        const auto found = made.find(object.mesh);
        if (found == made.end()) {
            placed.push_back(object);
            continue;
        }
        for (const Mesh& mesh : found->second) {
            Object& one = placed.emplace_back(object);
            one.mesh = mesh.name;
            if (&mesh != &found->second.front()) one.name = freeName(object.name + " gregory", taken);
        }
    }
    return placed;
}

}  // namespace

void SubdivisionOptions::validate() const {
    if (!(tolerance >= 1e-9 && tolerance <= 0.1)) {
        throw Error("subdivision tolerance " + numberText(static_cast<float>(tolerance)) + " is outside its range; give 1e-9 to 0.1");
    }
    if (!(creaseAngle >= 0.0 && creaseAngle <= 180.0)) {
        throw Error("crease angle " + numberText(static_cast<float>(creaseAngle)) + " is outside its range; give 0 to 180 degrees");
    }
}

std::vector<CageReport> subdivide(Scene& scene, const SubdivisionOptions& options) {
    options.validate();
    std::set<std::string, std::less<>> names = meshNames(scene), placed;
    for (const Object& object : scene.objects) placed.insert(object.mesh);
    std::vector<CageReport> reports;
    MeshesOfCages made;
    SubdivisionOptions own = options;
    for (const Cage& cage : scene.cages) {
        if (options.progress) {
            const auto before = static_cast<double>(reports.size()), all = static_cast<double>(scene.cages.size());
            own.progress = [&options, before, all](std::string_view stage, double part) { options.progress(stage, (before + part) / all); };
        }
        reports.push_back(meshCage(cage, own, placed.contains(cage.name), made));
        for (Mesh& mesh : made[cage.name]) {
            if (mesh.name != cage.name) mesh.name = freeName(mesh.name, names);
        }
    }
    // Nothing has been changed before here: where a cage is refused the scene stays as it was.
    scene.objects = placeMeshes(scene.objects, made);
    for (const Cage& cage : scene.cages) std::move(made[cage.name].begin(), made[cage.name].end(), std::back_inserter(scene.meshes));
    scene.cages.clear();
    return reports;
}

}  // namespace tessera
