#include "client/jobs/job_definition.h"

#include <gtest/gtest.h>

#include "proto/scene_loader.h"
#include "renderengine/engine.h"
#include "tests/support/fake_renderer.h"

using namespace antipode;

TEST(JobDefinition, ResolvesWhatDependsOnTheScene) {
    Scene scene = test::tinyScene();
    scene.maxPathLength = 7;
    const RenderSettings settings;
    const JobDefinition job = defineJob(scene, settings);
    EXPECT_EQ(job.settings.initialRadius, initialRadius(scene, settings));
    EXPECT_EQ(job.settings.maxPathLength, 7u);
    EXPECT_EQ(job.sceneHash, sceneHash(scene));
    EXPECT_EQ(job.kernelHash, kernelHash());
}

TEST(JobDefinition, KeepsWhatIsGiven) {
    Scene scene = test::tinyScene();
    scene.maxPathLength = 7;
    RenderSettings settings;
    settings.maxPathLength = 3;
    settings.initialRadius = 0.5;
    const JobDefinition job = defineJob(scene, settings);
    EXPECT_EQ(job.settings.maxPathLength, 3u);
    EXPECT_EQ(job.settings.initialRadius, 0.5);
}
