#include "support/hard_case.h"
#include "tests/large_scene/cave_furnace.h"

namespace antipode::test {
namespace {

class TenMillionTriangles : public CaveFurnace {
protected:
    TenMillionTriangles() : CaveFurnace(913) {}
};

TEST_F(TenMillionTriangles, EveryPathOfAClosedFurnaceIsExact) {
    ASSERT_NO_FATAL_FAILURE(render("--technique pt-naive --no-russian-roulette"));
    expectWithin({"Bad input", "a file of ten million triangles, every one of them a light",
                  "largest relative error of a pixel", 1e-5},
                 largestRelativeError(), device);
}

}  // namespace
}  // namespace antipode::test
