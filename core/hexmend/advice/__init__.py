"""Explanation of a run that ended, with suggestions for the next one.

>>> from hexmend.gallery import make
>>> from hexmend.run import StoppingCriteria, smooth
>>> advice = advise(smooth(make("bridge-sharp", size=864), "laplacian", StoppingCriteria(keep_last=True)))
>>> print(advice.reason)
Converged: in the last of 48 iterations no node moved further than 0.0001 mean edge lengths.
>>> print(advice.state)
12 of 864 hexes are inverted. None was at the start.
>>> print(advice.regressions)
Worse than at the start: inverted 0 → 12, invalid 0 → 12, q min 0.2522 → 0.1774, scaled Jacobian min 0.1625 → -0.8854.
>>> [suggestion.title for suggestion in advice.suggestions]
['Mend', 'Undo, then Smart Laplacian']
"""

from hexmend.advice.advice import Advice, advise
from hexmend.advice.suggestion import Suggestion

__all__ = ["Advice", "Suggestion", "advise"]
