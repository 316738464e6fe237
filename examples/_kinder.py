"""Episodes of KinDER through their public interface: `reset`, `step` and the public state."""

from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt

State = dict[str, dict[str, float]]


class Episode:
    """One episode of an environment, with its object-centric state."""

    def __init__(self, name: str, seed: int, steps: int) -> None:
        self.seed, self.most, self.steps, self.done = seed, steps, 0, False
        self.env = gymnasium.make(name)
        observation, _ = self.env.reset(seed=seed)
        self._read(observation)

    def _read(self, observation: npt.NDArray[Any]) -> None:
        space: Any = self.env.observation_space
        state = space.devectorize(observation)
        self.state: State = {
            thing.name: dict(zip(state.type_features[thing.type], map(float, state.data[thing])))
            for thing in state
        }

    @property
    def over(self) -> bool:
        return self.done or self.steps >= self.most

    def act(self, action: npt.ArrayLike) -> None:
        """Makes one step with an action, clipped to the allowed range."""
        space: Any = self.env.action_space
        clipped = np.clip(action, space.low, space.high).astype(space.dtype)
        observation, _, self.done, _, _ = self.env.step(clipped)
        self.steps += 1
        self._read(observation)
