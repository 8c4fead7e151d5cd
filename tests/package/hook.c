/* Succeeds when the library learns by itself that ODE's world is stepped. */
#include <ode/ode.h>
#include <ode_softbody/softbody.h>

int main(void) {
    dInitODE2(0);
    dWorldID world = dWorldCreate();
    dSpaceID space = dSimpleSpaceCreate(NULL);
    int interposed = dSoftWorldGetHook(dSoftWorldCreate(world, space)) == dSoftHookInterposed;
    dWorldDestroy(world);
    dSpaceDestroy(space);
    dCloseODE();
    return !interposed;
}
