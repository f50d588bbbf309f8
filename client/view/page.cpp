#include "client/view/page.h"

#include "terminal/embedded_file.h"

ANTIPODE_EMBED(antipode_view_page, ANTIPODE_VIEW_PAGE);

namespace antipode::view {

std::string_view page() { return {antipode_view_page, size_t(antipode_view_page_end - antipode_view_page)}; }

}  // namespace antipode::view
