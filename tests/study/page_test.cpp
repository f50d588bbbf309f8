// The page in a browser: does it draw, does the slider move, does anything complain.
#include "client/study/page.h"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "client/study/study_json.h"
#include "tests/film/temporary_folder.h"
#include "tests/study/study_fixture.h"

using namespace antipode;
using namespace antipode::study;

namespace {

std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool browserIsThere() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

struct Browsed {
    std::string document, log;
};

/// The page's document after its scripts and `probe` have run, and what its console said.
Browsed browse(const std::string& page, const std::string& probe) {
    const antipode::test::TemporaryFolder folder;
    std::string probed = page;
    probed.replace(probed.rfind("</body>"), 7, "<script>" + probe + "</script></body>");
    std::ofstream(folder.file("index.html")) << probed;
    const std::string command = "HOME='" + folder.file("home") +
                                "' timeout 120 chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr "
                                "--virtual-time-budget=4000 --user-data-dir='" +
                                folder.file("profile") + "' --dump-dom 'file://" + folder.file("index.html") + "' >'" +
                                folder.file("dom") + "' 2>'" + folder.file("log") + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << contentOf(folder.file("log"));
    return {contentOf(folder.file("dom")), contentOf(folder.file("log"))};
}

std::string page() { return studyPage(studyJson({study::test::sceneOfThree()}, true)); }

}  // namespace

TEST(StudyPage, NeedsNoNetworkAndCarriesTheLicence) {
    const std::string text = page();
    EXPECT_EQ(text.find("src=\"http"), std::string::npos);
    EXPECT_EQ(text.find("href=\"http"), std::string::npos);
    EXPECT_NE(text.find("Permission is hereby granted, free of charge"), std::string::npos);
    EXPECT_EQ(text.find("A \\\"room\\\" </script>"), std::string::npos) << "a scene's name ends the script";
}

TEST(StudyPage, DrawsPlotsMovesTheSliderAndSaysNothing) {
    if (!browserIsThere()) GTEST_SKIP() << "There is no Chromium on this machine: the page is not opened.";
    const Browsed seen = browse(page(), R"(
        addEventListener("load", () => {
          const tell = (name, value) => document.documentElement.setAttribute("probe-" + name, value);
          const painted = [...document.querySelectorAll("canvas")].map(c => {
            const pixels = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
            const colours = new Set();
            for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 200) colours.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
            return colours.size > 2;
          });
          tell("plots", painted.length + " " + painted.every(x => x));
          const slider = document.querySelector("input[type=range]"), over = document.querySelectorAll(".stage img")[1];
          slider.value = 25; slider.dispatchEvent(new Event("input"));
          tell("slider", over.style.clipPath + " " + document.querySelector(".handle").style.left);
          tell("pictures", [...document.querySelectorAll(".stage img")].every(i => i.naturalWidth === 32));
          document.querySelectorAll("#clocks button")[1].click();
          tell("table", document.querySelector("table").textContent);
          tell("prices", document.querySelectorAll(".prices li").length);
        });)");
    EXPECT_EQ(seen.log.find("CONSOLE"), std::string::npos) << seen.log;
    for (const char* text :
         {"data-ready=\"yes\"", "probe-plots=\"3 true\"", "probe-slider=\"inset(0px 75% 0px 0px) 25%\"",
          "probe-pictures=\"true\"", "probe-prices=\"2\"", "A \"room\" &lt;/script&gt;"})
        EXPECT_NE(seen.document.find(text), std::string::npos) << text;
    // vcm is at 5 % after 1.6 s by the wall clock, 3.04 by the CPU's, which was asked for.
    const size_t table = seen.document.find("probe-table=");
    EXPECT_NE(seen.document.find("3 s", table), std::string::npos);
}

// The test's own test: a page that complains is noticed.
TEST(StudyPage, AComplaintIsNoticed) {
    if (!browserIsThere()) GTEST_SKIP() << "There is no Chromium on this machine: the page is not opened.";
    EXPECT_NE(browse(page(), "nothingOfThatName();").log.find("CONSOLE"), std::string::npos);
}
