// Renders a glass sphere on a floor under a lamp to the PNG that the command line names.
#include <iostream>

#include <renderengine/engine.h>
#include <renderengine/error.h>
#include <renderengine/version.h>

using namespace antipode;

int main(int argc, char** argv) try {
    if (argc != 2) throw Error(ErrorCode::Usage, "Name the PNG to write.");
    Scene scene;
    scene.name = "glass sphere";
    scene.materials.resize(3);
    scene.materials[0].baseColor = Vec3f(0.7f);
    scene.materials[1].kind = MaterialKind::Dielectric;
    scene.materials[1].ior = 1.5f;
    scene.materials[2].emission = Vec3f(20.0f);  // W/(sr·m²)

    Mesh floor;
    floor.positions = {{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}};
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes = {floor};
    scene.spheres = {{{0, 1, 0}, 1.0f, 1}, {{1, 3, 1}, 0.3f, 2}};
    scene.camera.position = {0, 1, 6};

    RenderSettings settings;
    settings.width = settings.height = 64;
    settings.maxPathLength = 8;
    Engine engine(scene, settings);
    for (uint64_t iteration = 1; iteration <= 4; ++iteration) engine.render(iteration);
    const FilmSums sums = engine.sums();
    if (!sums.events.clean()) throw Error(ErrorCode::Device, "The render is not clean.");
    writePng(argv[1], sums.image());
    std::cout << "antipode " << versionText << " on " << engine.deviceName() << ": " << sums.sha256() << std::endl;
} catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 1;
}
