/* mortise.h -- contact of linearly elastic bodies: every module's contract, in the order of the floors. */
#ifndef MORTISE_H
#define MORTISE_H

#include <mortise/compat.h>
#include <mortise/log.h>
#include <mortise/memory.h>
#include <mortise/fault.h>
#include <mortise/interrupt.h>
#include <mortise/options.h>
#include <mortise/json.h>
#include <mortise/warning.h>
#include <mortise/expression.h>
#include <mortise/material.h>
#include <mortise/element.h>
#include <mortise/dual.h>
#include <mortise/clip.h>
#include <mortise/frame.h>
#include <mortise/boxtree.h>
#include <mortise/scene.h>
#include <mortise/mesh.h>
#include <mortise/support.h>
#include <mortise/obstacle.h>
#include <mortise/pair.h>
#include <mortise/elasticity.h>
#include <mortise/rigid.h>
#include <mortise/vi.h>
#include <mortise/pdas.h>
#include <mortise/solve.h>
#include <mortise/fields.h>
#include <mortise/certificate.h>
#include <mortise/errors.h>
#include <mortise/pairsum.h>
#include <mortise/probes.h>
#include <mortise/output.h>
#include <mortise/summary.h>
#include <mortise/page.h>
#include <mortise/run.h>
#include <mortise/study.h>

#endif
