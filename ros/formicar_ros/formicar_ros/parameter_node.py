"""A lifecycle node whose parameters are checked as a whole, by formicar and in its words."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from functools import partial
from typing import Any

from lifecycle_msgs.srv import ChangeState
from rcl_interfaces.msg import SetParametersResult
from rclpy.lifecycle import LifecycleNode
from rclpy.parameter import Parameter

from .parameters import (
    FIXED,
    Declaration,
    node_declarations,
    own_names,
    plugin_declarations,
    word_declaration,
)
from .settings import Settings, settings_of


class ParameterNode(LifecycleNode):  # type: ignore[misc]
    """Declares the parameters, and keeps the settings that they make."""

    def __init__(self, name: str, **how: Any) -> None:
        self._settings: Settings | None = None
        self._config_keys: dict[str, list[str]] = {}
        super().__init__(name, **how)
        self._guard_transitions()
        for parameter, default, descriptor in node_declarations():
            self.declare_parameter(parameter, default, descriptor)

    def _guard_transitions(self) -> None:
        """Refuse transitions that the state does not allow; rclpy raises, and answers nobody."""
        for service in self.services:
            if service.srv_type is ChangeState:
                service.callback = partial(self._change_state, service.callback)

    def _change_state(self, change: Callable[[Any, Any], Any], request: Any, response: Any) -> Any:
        try:
            return change(request, response)
        except RuntimeError as error:
            self.get_logger().warning(f"no transition {request.transition.id} now: {error}")
            response.success = False
            return response

    @property
    def settings(self) -> Settings:
        """What the parameters decide; only while the node is configured."""
        assert self._settings is not None, "the node is configured"
        return self._settings

    def value(self, name: str) -> Any:
        """Return the value of a parameter."""
        return self.get_parameter(name).value

    def configure_settings(self) -> None:
        """Declare the parameters of the planners, and check everything.

        Raises
        ------
        ValueError
            A value that cannot be.
        """
        plugins = self.value("planner_plugins")
        if not plugins or len(set(plugins)) != len(plugins):
            raise ValueError(f"planner_plugins = {plugins}; expected names, each once")
        self._config_keys = {}
        declared: list[Declaration] = []
        for plugin in plugins:
            declared += self._declare_plugin(plugin)
        self._name_unknown()
        self._settings = settings_of(self._values(), self._config_keys)
        # Ranges come last, so that formicar is asked first about values from a file.
        for name, _, descriptor in declared:
            self.set_descriptor(name, descriptor)

    def drop_settings(self) -> None:
        """Let parameters be anything until the node is configured again."""
        self._settings = None

    def on_settings_changed(self) -> None:
        """Heed new settings."""

    def _declare_plugin(self, plugin: str) -> list[Declaration]:
        name, default, descriptor = word_declaration(plugin)
        if not self.has_parameter(name):
            self.declare_parameter(name, default, descriptor)
        declarations = plugin_declarations(plugin, self.value(name))
        own = own_names(plugin)
        names = [name for name, _, _ in declarations]
        self._config_keys[plugin] = [
            name.removeprefix(f"{plugin}.") for name in names if name not in own
        ]
        self._undeclare_others(plugin, {*names, *own})
        for name, default, descriptor in declarations:
            if not self.has_parameter(name):
                plain = type(descriptor)(dynamic_typing=True)
                self.declare_parameter(name, default, plain)
        return declarations

    def _name_unknown(self) -> None:
        """Warn of parameters in a file or on the command line that nobody has declared."""
        given = getattr(self, "_parameter_overrides", {})
        known = [name for name in self._values() if name not in given]
        for name in given:
            if not self.has_parameter(name):
                near = difflib.get_close_matches(name, known, n=1)
                hint = f"; hint: {near[0]}" if near else ""
                self.get_logger().warning(f"no parameter is named {name}; it is ignored{hint}")

    def _undeclare_others(self, plugin: str, kept: set[str]) -> None:
        """Forget the parameters of a planner that stood behind this name before."""
        for key in self.get_parameters_by_prefix(plugin):
            if f"{plugin}.{key}" not in kept:
                self.undeclare_parameter(f"{plugin}.{key}")

    def _values(self) -> dict[str, Any]:
        names = [name for name, _, _ in node_declarations()]
        for plugin, keys in self._config_keys.items():
            names += [*own_names(plugin), *(f"{plugin}.{key}" for key in keys)]
        return {name: self.value(name) for name in names}

    def set_parameters(self, parameter_list: list[Parameter]) -> list[SetParametersResult]:
        """Set parameters one by one, each as `set_parameters_atomically`."""
        return [self.set_parameters_atomically([parameter]) for parameter in parameter_list]

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Set parameters together, or refuse them together, with formicar's reason."""
        if self._settings is None:
            return super().set_parameters_atomically(parameter_list)
        try:
            settings = self._with(parameter_list)
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        result = super().set_parameters_atomically(parameter_list)
        if result.successful and settings != self._settings:
            self._settings = settings
            self.on_settings_changed()
        return result

    def _with(self, parameter_list: list[Parameter]) -> Settings:
        values = self._values()
        for parameter in parameter_list:
            self._check_free(parameter.name, parameter.value, values)
            if parameter.name in values:
                values[parameter.name] = parameter.value
        return settings_of(values, self._config_keys)

    def _check_free(self, name: str, value: Any, values: dict[str, Any]) -> None:
        fixed = {*FIXED, *(f"{plugin}.planner" for plugin in self._config_keys)}
        if name in fixed and value != values.get(name):
            raise ValueError(
                f"{name} is read when the node is configured; hint: clean up, set it, configure"
            )
