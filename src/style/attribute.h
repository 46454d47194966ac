/** Attributes of atoms: what dumps, averages and computes can read of each atom by name. */
#ifndef HS_STYLE_ATTRIBUTE_H
#define HS_STYLE_ATTRIBUTE_H

#include "style/env.h"

/** Attributes of an atom, in the order of hs_attributes. */
typedef enum {
    HS_ATTR_ID,
    HS_ATTR_TYPE,
    HS_ATTR_ELEMENT,
    HS_ATTR_MASS,
    HS_ATTR_PROC,
    HS_ATTR_PROCP1,
    HS_ATTR_X,
    HS_ATTR_Y,
    HS_ATTR_Z,
    HS_ATTR_XS,
    HS_ATTR_YS,
    HS_ATTR_ZS,
    HS_ATTR_XU,
    HS_ATTR_YU,
    HS_ATTR_ZU,
    HS_ATTR_XSU,
    HS_ATTR_YSU,
    HS_ATTR_ZSU,
    HS_ATTR_IX,
    HS_ATTR_IY,
    HS_ATTR_IZ,
    HS_ATTR_VX,
    HS_ATTR_VY,
    HS_ATTR_VZ,
    HS_ATTR_FX,
    HS_ATTR_FY,
    HS_ATTR_FZ,
    HS_ATTR_MUX,
    HS_ATTR_MUY,
    HS_ATTR_MUZ,
    HS_ATTR_OMEGAX,
    HS_ATTR_OMEGAY,
    HS_ATTR_OMEGAZ,
    HS_ATTR_MU,
    HS_ATTR_RADIUS,
    HS_ATTR_DIAMETER,
    HS_N_ATTRIBUTES,
    HS_ATTR_VARIABLE = HS_N_ATTRIBUTES /**< a value per atom of a compute or fix, or an atom-style variable */
} hs_attribute;

/** Names of the attributes, ended by NULL. */
extern const char *const hs_attributes[];
/** The attribute of that name, or -1. */
int hs_attribute_find(const char *name);
/** An error when atoms of the present style have no such attribute. */
HS_MUST_USE hs_status hs_attribute_check(hs_attribute attribute, const hs_atoms *atoms, hs_error *err);
/** Value of local atom i (the element is its type's number). With @p is_wrapped, positions, images and velocities are
 *  those of the atom's image in the box. */
double hs_attribute_value(const hs_env *env, hs_attribute attribute, bool is_wrapped, int i);

#endif
