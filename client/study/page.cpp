#include "client/study/page.h"

#include <string_view>

#include "terminal/embedded_file.h"

ANTIPODE_EMBED(antipode_study_page, ANTIPODE_STUDY_PAGE);
ANTIPODE_EMBED(antipode_study_chart, ANTIPODE_CHART_JS);
ANTIPODE_EMBED(antipode_study_licence, ANTIPODE_CHART_LICENCE);

namespace antipode::study {
namespace {

void replace(std::string& text, std::string_view mark, std::string_view by) {
    text.replace(text.find(mark), mark.size(), by);
}

/// So that no text ends the element that it is in.
std::string inScript(std::string text) {
    for (size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) text.replace(at, 2, "<\\/");
    return text;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

}  // namespace

std::string studyPage(const std::string& json) {
    std::string page(antipode_study_page, antipode_study_page_end);
    replace(page, "@LICENCE@", escaped({antipode_study_licence, antipode_study_licence_end}));
    replace(page, "@CHART@", std::string_view(antipode_study_chart, antipode_study_chart_end));
    replace(page, "@DATA@", inScript(json));
    return page;
}

}  // namespace antipode::study
