// opencascade_sheet: nodes per second of Open CASCADE's incremental mesh, on the sheet's patches as faces of their own.
#include "mesh/comparator.h"
#include "mesh/sheet.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BezierSurface.hxx>
#include <Poly_Triangulation.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace tessera::bench;

// Faces share no edges: each patch is meshed by itself, as Tessera does it.
TopoDS_Compound facesOf(const Sheet& sheet) {
    const std::vector<glm::vec3> points = bezierPoints(sheet);
    BRep_Builder builder;
    TopoDS_Compound all;
    builder.MakeCompound(all);
    for (std::size_t patch = 0; patch < points.size(); patch += 16) {
        TColgp_Array2OfPnt poles(1, 4, 1, 4);
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i) {
                const glm::vec3& point = points[patch + static_cast<std::size_t>(4 * j + i)];
                poles.SetValue(i + 1, j + 1, gp_Pnt(point.x, point.y, point.z));
            }
        }
        const Handle(Geom_BezierSurface) surface = new Geom_BezierSurface(poles);
        builder.Add(all, BRepBuilderAPI_MakeFace(surface, 1e-7).Face());
    }
    return all;
}

struct Counts {
    double nodes = 0;
    double triangles = 0;
    double faces = 0;
    double distance = 0;  // greatest seen
};

// From the triangle's middle, and its sides', to the surface there: at equal parameters, so no less than the distance to the surface.
double greatestDistance(const Poly_Triangulation& mesh, const glm::vec3* patch) {
    constexpr std::array<glm::dvec3, 4> places{{{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}}};
    double greatest = 0;
    for (int i = 1; i <= mesh.NbTriangles(); ++i) {
        std::array<int, 3> corners{};
        mesh.Triangle(i).Get(corners[0], corners[1], corners[2]);
        for (const glm::dvec3& place : places) {
            glm::dvec3 flat(0.0);
            glm::dvec2 at(0.0);
            for (int k = 0; k < 3; ++k) {
                const int corner = corners[static_cast<std::size_t>(k)];
                const gp_Pnt point = mesh.Node(corner);
                const gp_Pnt2d uv = mesh.UVNode(corner);
                flat += place[k] * glm::dvec3(point.X(), point.Y(), point.Z());
                at += place[k] * glm::dvec2(uv.X(), uv.Y());
            }
            greatest = std::max(greatest, glm::length(flat - bezierPoint(patch, at.x, at.y)));
        }
    }
    return greatest;
}

Counts countsOf(const TopoDS_Shape& shape, const Sheet& sheet) {
    const std::vector<glm::vec3> points = bezierPoints(sheet);
    std::size_t first = 0;
    Counts counts;
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
        TopLoc_Location place;
        const Handle(Poly_Triangulation)& mesh = BRep_Tool::Triangulation(TopoDS::Face(face.Current()), place);
        if (mesh.IsNull()) throw std::runtime_error("Open CASCADE left a face without a mesh");
        counts.nodes += mesh->NbNodes();
        counts.triangles += mesh->NbTriangles();
        counts.faces += 1;
        counts.distance = std::max(counts.distance, greatestDistance(*mesh, &points[first]));
        first += 16;
    }
    return counts;
}

// Seconds a run, after one that is not measured. The mesh that is there would be kept where it is fine enough: it is cleaned away first,
// outside the time.
std::vector<double> meshed(TopoDS_Shape& shape, const IMeshTools_Parameters& parameters, int runs) {
    std::vector<double> seconds;
    for (int run = -1; run < runs; ++run) {
        BRepTools::Clean(shape);
        const auto start = std::chrono::steady_clock::now();
        const BRepMesh_IncrementalMesh mesher(shape, parameters);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        if (run >= 0) seconds.push_back(taken.count());
    }
    return seconds;
}

void measure(const std::map<std::string, double>& options) {
    const Sheet sheet = makeSheet(static_cast<int>(options.at("along")));
    const int runs = static_cast<int>(options.at("runs"));
    TopoDS_Compound faces = facesOf(sheet);
    IMeshTools_Parameters parameters;
    parameters.Deflection = options.at("tolerance");
    // The distance alone is to decide.
    parameters.Angle = std::numbers::pi;
    parameters.AngleInterior = std::numbers::pi;
    for (const bool parallel : {false, true}) {
        parameters.InParallel = parallel;
        const std::vector<double> seconds = meshed(faces, parameters, runs);
        const Counts counts = countsOf(faces, sheet);
        printRuns(parallel ? "parallel" : "single",
                  {{"nodes", counts.nodes},
                   {"triangles", counts.triangles},
                   {"faces", counts.faces},
                   {"tolerance", parameters.Deflection},
                   {"distance", counts.distance}},
                  seconds);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return guarded("opencascade_sheet", [&] { measure(numberOptions(argc, argv, {{"along", 32}, {"tolerance", 1e-3}, {"runs", 1}})); });
}
