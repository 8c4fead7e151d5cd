/** @file
 * Vibration modes of a mesh at rest, with the band in which each frequency lies. Conventions:
 * softbody.h.
 */
#ifndef ODE_SOFTBODY_MODES_H
#define ODE_SOFTBODY_MODES_H

#include <ode_softbody/mesh.h>
#include <ode_softbody/solid.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dxSoftModes* dSoftModesID;

/** Called now and then during dSoftModesCompute(), on its thread.
 * @param stage  "assemble", "factorise", "modes", "verify" or "cubic"; stages may come again.
 * @param share  of this stage that is done, 0 to 1.
 * @param modes  found so far.
 * @return 0 to cancel. */
typedef int dSoftModesProgress(void* data, const char* stage, dReal share, int modes);

/** How modes are computed. Start from dSoftModesOptionsDefault(). */
typedef struct dSoftModesOptions {
    unsigned struct_size;
    int order;           /**< of the displacement in an element: 1, 2 or 3 (default), whatever the
                              mesh's. 3 costs some three times 2 and errs a tenth of it */
    int lumped;          /**< 1: diagonal mass; 0 (default): consistent, more accurate */
    int count;           /**< lowest modes only; 0 (default): all up to max_frequency */
    dReal max_frequency; /**< [Hz], default 22000; dInfinity needs a count */
    int rebuilt_curves;  /**< 1 (default): facets that meet at less than 50 degrees are taken for a
                              smooth surface, and its curvature is rebuilt; 0: facets are meant */
    int use_cache;       /**< 1 (default): results are kept, see dSoftGetCacheDirectory() */
    dReal tolerance;     /**< [cents]: refine until no band of the first `tolerance_count` modes is
                              wider; 0 (default): take the mesh as it is */
    int tolerance_count; /**< default 8 */
    int max_nodes;       /**< refinement to a tolerance stops here; default 200000 */
    dSoftModesProgress* progress; /**< may be NULL */
    void* progress_data;
} dSoftModesOptions;
DSOFT_API dSoftModesOptions dSoftModesOptionsDefault(void);

/** Natural frequencies and shapes of a body at rest: small vibrations, undamped, no prestress.
 * Each frequency comes with a band, measured by the change from one element order to the next: it
 * holds the exact frequency of the meshed body in some 95 of 100 cases. It says nothing about
 * material constants. The result belongs to the caller and needs the mesh no more.
 * @param solids   one for each physical group of the mesh, in order, or one for all.
 * @param clamped  nodes held still; edges and faces between them are, too. NULL and 0: free.
 * @return NULL after a sentence: bad input, too little memory, tolerance not met, cancelled. */
DSOFT_API dSoftModesID dSoftModesCompute(dSoftMeshID mesh, const dSoftSolid* solids,
                                         int solid_count, const int* clamped, int clamped_count,
                                         const dSoftModesOptions* options);
DSOFT_API void dSoftModesDestroy(dSoftModesID modes);

/** Elastic modes found; motions without strain are not among them. */
DSOFT_API int dSoftModesGetCount(dSoftModesID modes);
/** Frequencies [Hz], ascending; borrowed while the modes live. @return how many. */
DSOFT_API int dSoftModesGetFrequencies(dSoftModesID modes, const dReal** first);
/** Half-widths of the bands [cents, 1200 an octave]; borrowed. @return how many. */
DSOFT_API int dSoftModesGetErrorCents(dSoftModesID modes, const dReal** first);
/** Time in which each mode falls by 60 dB [s], by the damping of the solids; infinite without;
 * borrowed. Exact for one solid; of several, each counts by its share of the mode's energy, which
 * is taken from the shape on the mesh as given. @return how many. */
DSOFT_API int dSoftModesGetT60(dSoftModesID modes, const dReal** first);
/** Displacement of the mesh's nodes in a mode, mass-normalised [kg^-1/2]; borrowed.
 * @param first  out: x of node 0.  @param stride out: dReals from node to node.
 * @return node count; 0 for a mode that there isn't. */
DSOFT_API int dSoftModesGetShape(dSoftModesID modes, int mode, const dReal** first, int* stride);

/** Where results that take long are kept from run to run: $ODE_SOFTBODY_CACHE, else
 * $XDG_CACHE_HOME/ode_softbody, else ~/.cache/ode_softbody. Modes, cubic terms, how modes sound.
 * @return NULL where ODE_SOFTBODY_CACHE is set to nothing, or there is no home; else borrowed until
 * this thread asks again. */
DSOFT_API const char* dSoftGetCacheDirectory(void);

/** The body that was solved. Start with struct_size = sizeof(dSoftModesInfo). */
typedef struct dSoftModesInfo {
    unsigned struct_size;
    int nodes;           /**< of the mesh as given */
    int elements;        /**< of the mesh as given */
    int solved_nodes;    /**< of the mesh after rebuilding and refinement */
    int refinements;     /**< cuts of each element into eight */
    int rigid_modes;     /**< motions without strain: 6 of a free body */
    int complete;        /**< 1: no mode below max_frequency is missing */
    dReal mass;          /**< [kg], like the rest of the body with its surface rebuilt */
    dReal volume;        /**< [m^3] */
    dReal center[3];     /**< of mass [m] */
    dReal inertia[3][3]; /**< about the centre of mass, mesh axes [kg m^2] */
    int curved_edges;    /**< surface edges that were given curvature */
    int limited_edges;   /**< whose curvature had to be cut down to keep elements valid */
    int doubtful_edges;  /**< round or corner? see dSoftMeshQuality */
} dSoftModesInfo;
DSOFT_API int dSoftModesGetInfo(dSoftModesID modes, dSoftModesInfo* info);

#ifdef __cplusplus
}
#endif

#endif
