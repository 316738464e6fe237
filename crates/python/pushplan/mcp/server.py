"""Server on stdin and stdout: tools, resources, progress, cancellation and limits."""

from __future__ import annotations

import io
import json
import re
import sys
from dataclasses import dataclass
from typing import Any, Optional, cast

import anyio
import mcp_types as types
from mcp.server import Server, ServerRequestContext
from mcp.server.stdio import stdio_server
from mcp.shared.exceptions import MCPError

from pushplan import __version__

from .._ending import until_signal
from . import resources
from .declared import DESCRIPTIONS, FILES, OUTPUT, PROPERTIES, SAVED, schema
from .folder import Folder
from .inputs import InputError
from .supervisor import Supervisor
from .worker import stopped

__all__ = ["Limits", "serve"]

#: Maximum length of a message, characters; longer ones are skipped.
LONGEST = 8 << 20
INSTRUCTIONS = (
    "pushplan chooses tools and pushes that bring objects on a table to goals. Write a task "
    "(resource pushplan://book/tasks), call `check`, then `solve`. Only the status `solved` states "
    "that a plan works. Otherwise read `cause`, and apply a repair from `repairs` if its `changes` "
    "are possible on your table."
)


@dataclass(frozen=True)
class Limits:
    """Limits of the server."""

    #: Maximum duration of a call, seconds.
    time: float
    #: Maximum memory of the planner, MiB; 0 for none.
    memory: int
    #: Maximum size of the arguments of a call and of a file, bytes.
    size: int
    #: Number of worker threads; 0 for one per core.
    threads: int


def serve(limits: Limits, folder: Optional[Folder]) -> None:
    """Serves until stdin ends, or until a signal ends the process."""
    supervisor = Supervisor(limits.memory, limits.threads)
    # A thread that waits for stdin cannot be interrupted.
    until_signal(lambda: anyio.run(_serve, limits, folder, supervisor), supervisor.kill)


async def _serve(limits: Limits, folder: Optional[Folder], supervisor: Supervisor) -> None:
    handlers = _Handlers(limits, folder, supervisor)
    server: Server[Any] = Server(
        "pushplan",
        version=__version__,
        instructions=INSTRUCTIONS,
        on_list_tools=handlers.list_tools,
        on_call_tool=handlers.call_tool,
        on_list_resources=handlers.list_resources,
        on_read_resource=handlers.read_resource,
    )
    text = io.TextIOWrapper(sys.stdin.buffer, encoding="utf-8", errors="replace")
    lines: Any = anyio.AsyncFile(cast(Any, _Lines(text)))
    try:
        async with stdio_server(stdin=lines) as (read, write):
            await server.run(read, write, server.create_initialization_options())
    finally:
        await supervisor.close()


class _Lines:
    """Lines of stdin; a line that is too long becomes a request of an unknown method."""

    def __init__(self, text: io.TextIOBase) -> None:
        self.text = text

    def readline(self) -> str:
        """Returns the next line, empty at the end."""
        line = self.text.readline(LONGEST)
        if len(line) < LONGEST or line.endswith("\n"):
            return line
        head = line[:400]
        while line and not line.endswith("\n"):
            line = self.text.readline(LONGEST)
        found = re.search(r'"id"\s*:\s*(\d{1,18}|"[\w-]{1,64}")', head)
        method = f"message longer than {LONGEST} characters"
        return f'{{"jsonrpc": "2.0", "id": {found[1] if found else 0}, "method": "{method}"}}\n'


class _Handlers:
    """Handlers of the requests."""

    def __init__(self, limits: Limits, folder: Optional[Folder], supervisor: Supervisor) -> None:
        self.limits, self.folder, self.supervisor = limits, folder, supervisor

    async def list_tools(
        self, _: ServerRequestContext[Any], __: Optional[types.PaginatedRequestParams]
    ) -> types.ListToolsResult:
        reads_only = self.folder is None
        tools = [
            types.Tool(
                name=name,
                description=text,
                input_schema=schema(name, self.folder is not None),
                output_schema=OUTPUT,
                annotations=types.ToolAnnotations(
                    read_only_hint=reads_only or name not in SAVED,
                    destructive_hint=False,
                    idempotent_hint=True,
                    open_world_hint=False,
                ),
            )
            for name, text in DESCRIPTIONS.items()
        ]
        return types.ListToolsResult(tools=tools)

    async def call_tool(
        self, context: ServerRequestContext[Any], params: types.CallToolRequestParams
    ) -> types.CallToolResult:
        if params.name not in PROPERTIES:
            names = ", ".join(PROPERTIES)
            raise MCPError(types.INVALID_PARAMS, f"no tool `{params.name[:80]}`; use {names}")
        try:
            answer = await self._answer(context, params.name, params.arguments or {})
        except InputError as error:
            answer = stopped("invalid", str(error))
        return _result(answer)

    async def _answer(
        self, context: ServerRequestContext[Any], name: str, arguments: dict[str, Any]
    ) -> dict[str, Any]:
        try:
            size = len(json.dumps(arguments))
        except (ValueError, RecursionError) as error:
            raise InputError(f"the arguments are not plain JSON: {error}") from error
        if size > self.limits.size:
            raise InputError(
                f"the arguments take {size} bytes, but the limit is {self.limits.size}; use a "
                "smaller task, or start the server with a larger --size"
            )
        arguments = dict(arguments)
        save_as = arguments.pop("save_as", None)
        if save_as is not None and (name not in SAVED or self.folder is None):
            raise InputError(_NO_FILES if name in SAVED else f"`{name}` writes no file")
        for key, replaced in FILES.items():
            if key in arguments:
                arguments[replaced] = self._read(arguments.pop(key))
        limit = self.limits.time
        wanted = arguments.get("time_limit")
        if isinstance(wanted, (int, float)) and 0.1 <= wanted <= limit:
            limit = float(wanted)

        async def report(seconds: float, message: str) -> None:
            await context.session.report_progress(round(seconds, 2), limit, message)

        answer = await self.supervisor.call(name, arguments, limit, report)
        if save_as is not None and self.folder is not None and SAVED[name] in answer:
            value = answer[SAVED[name]]
            text = value if isinstance(value, str) else json.dumps(value, indent=1) + "\n"
            answer["saved_as"] = self.folder.write(save_as, text)
        return answer

    def _read(self, name: object) -> str:
        if self.folder is None:
            raise InputError(_NO_FILES)
        return self.folder.read(name)

    async def list_resources(
        self, _: ServerRequestContext[Any], __: Optional[types.PaginatedRequestParams]
    ) -> types.ListResourcesResult:
        found = [
            types.Resource(uri=uri, name=name, description=text, mime_type=kind)
            for uri, name, text, kind, _ in resources.listed()
        ]
        return types.ListResourcesResult(resources=found)

    async def read_resource(
        self, _: ServerRequestContext[Any], params: types.ReadResourceRequestParams
    ) -> types.ReadResourceResult:
        address = str(params.uri)
        try:
            text, kind = resources.text_of(address)
        except KeyError:
            known = "list the resources for their addresses"
            raise MCPError(
                types.INVALID_PARAMS, f"no resource `{address[:200]}`; {known}"
            ) from None
        contents = types.TextResourceContents(uri=address, mime_type=kind, text=text)
        return types.ReadResourceResult(contents=[contents])


_NO_FILES = (
    "the server has no folder, and reads and writes no files; pass texts, or start it with --folder"
)


def _result(answer: dict[str, Any]) -> types.CallToolResult:
    """Returns the answer as structured content and as text, with its image as an image."""
    png = answer.pop("png", None)
    content: list[Any] = [types.TextContent(type="text", text=json.dumps(answer))]
    if png is not None:
        content.append(types.ImageContent(type="image", data=png, mime_type="image/png"))
    failed = answer["status"] in ("invalid", "error", "memory", "time_limit")
    return types.CallToolResult(content=content, structured_content=answer, is_error=failed)
