#include "style/box_shape.h"

#include <math.h>

const char *const hs_tilt_names[] = {"xy", "xz", "yz", NULL};

void hs_box_say(hs_sink *out, const char *before, const hs_box *box)
{
    hs_say(out, "%s%s box = (%#.8g %#.8g %#.8g) to (%#.8g %#.8g %#.8g)", before,
           box->is_tilted ? "triclinic" : "orthogonal", box->lo[0], box->lo[1], box->lo[2], box->hi[0], box->hi[1],
           box->hi[2]);
    if (box->is_tilted) hs_say(out, " with tilt (%#.8g %#.8g %#.8g)", box->tilt[0], box->tilt[1], box->tilt[2]);
    hs_say(out, "\n");
}

hs_status hs_box_check_shape(const hs_box *box, bool may_be_skewed, hs_sink *out, const char *command, hs_error *err)
{
    HS_TRY(hs_box_check_tilt(box, command, err));
    for (int k = 0; k < 3; ++k) {
        const int axis = hs_tilt_first(k);
        const double tilt = box->tilt[k], edge = hs_box_length(box, axis);
        /* without images along that axis there is no equivalent box that is tilted less */
        if (!box->periodic[axis] || !(fabs(tilt) > 0.5 * edge)) continue;
        if (!may_be_skewed)
            return hs_fail(
                err, HS_ERROR_INPUT,
                "%s: the tilt %s, %.8g, is more than half of the box's length in %c, %.8g; %s = %.8g gives the "
                "same images, and 'box tilt large' allows boxes as skewed as this",
                command, hs_tilt_names[k], tilt, "xyz"[axis], edge, hs_tilt_names[k], tilt - round(tilt / edge) * edge);
        hs_warn(out, "%s: the box is skewed (%s = %.8g, length %.8g): it has more surface to its volume than need be",
                command, hs_tilt_names[k], tilt, edge);
    }
    return HS_OK;
}

hs_status hs_box_check_tilt_changes(const hs_box *box, int tilt, const char *command, hs_error *err)
{
    const int second = hs_tilt_second(tilt);
    if (second >= box->dimension)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d box can be tilted along xy only, not along %s", command,
                       hs_tilt_names[tilt]);
    if (!box->is_tilted)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the tilt %s of an orthogonal box cannot change; 'change_box all triclinic' makes the box "
                       "one that can be tilted, as does a region of style prism in create_box",
                       command, hs_tilt_names[tilt]);
    if (!box->periodic[second])
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the tilt %s shifts what crosses the faces of %c, which must be periodic ('boundary')",
                       command, hs_tilt_names[tilt], "xyz"[second]);
    return HS_OK;
}
