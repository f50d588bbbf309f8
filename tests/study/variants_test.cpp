#include "client/study/variants.h"

#include <set>

#include <gtest/gtest.h>

#include "renderengine/error.h"

using namespace antipode;
using namespace antipode::study;

TEST(Variants, TheBaseComesFirstAndIsMeasuredAgainstNothing) {
    const std::vector<Variant> all = allVariants("bpt");
    EXPECT_EQ(all[0].name, "bpt");
    EXPECT_EQ(all[0].against, "");
    std::set<std::string> names;
    for (const Variant& variant : all) {
        EXPECT_TRUE(names.insert(variant.name).second) << variant.name;
        EXPECT_TRUE(&variant == &all[0] || names.contains(variant.against)) << variant.name;
    }
}

TEST(Variants, EachKnobChangesTheSettingsAndEnginesTakeThem) {
    for (const Variant& variant : allVariants("vcm")) {
        RenderSettings settings = variant.settings;
        const RenderSettings before = settings;
        turnKnob(variant.name, settings);
        EXPECT_NO_THROW(checkSettings(settings)) << variant.name;
        const bool same = settings.precision == before.precision && settings.sampler == before.sampler &&
                          settings.radiusFactor == before.radiusFactor && settings.alpha == before.alpha &&
                          settings.lightPathCount == before.lightPathCount &&
                          settings.connectionsPerVertex == before.connectionsPerVertex &&
                          settings.maxPathLength == before.maxPathLength &&
                          settings.russianRoulette == before.russianRoulette;
        EXPECT_EQ(same, variant.technique) << variant.name;
    }
}

TEST(Variants, ChoosingBringsWhatItIsMeasuredAgainst) {
    const auto names = [](const std::string& list) {
        std::string text;
        for (const Variant& variant : chooseVariants("vcm", list)) text += variant.name + " ";
        return text;
    };
    EXPECT_EQ(names("double"), "vcm double ");
    EXPECT_EQ(names("no-roulette,pt"), "vcm pt length-10 no-roulette ");
    EXPECT_EQ(names("techniques").substr(0, 4), "vcm ");
    EXPECT_EQ(chooseVariants("vcm", "all").size(), allVariants("vcm").size());
}

TEST(Variants, UnknownNamesAreRefusedWithTheNearest) {
    try {
        chooseVariants("vcm", "pt,doubel");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        EXPECT_NE(std::string(error.what()).find("not 'doubel'. Did you mean 'double'?"), std::string::npos);
    }
    EXPECT_THROW(chooseVariants("vcm", ""), Error);
}
